#pragma once
// One power function for every width, so that highlights are the same bytes on every ISA: no libm.

#include "simd/batch.hpp"

namespace lanecast::inline LANECAST_ISA {

/// log2(x) for normal x > 0. m = 2^-e x in [sqrt(1/2), sqrt(2)), s = (m - 1) / (m + 1), log2 m = 2 / ln 2 * atanh(s): the error
/// is relative to the result also near x = 1, where a large exponent would magnify an absolute one.
template <FloatBatch F>
LANECAST_INLINE F log2(F x) {
    using S = Scalar<F>;
    F e;
    const F m = split_exponent(x, e);
    const F s = (m - F(1)) / (m + F(1));
    const F s2 = s * s;
    // |s| <= 0.1716, so the next term is below 2^-26 (float, 5 terms) and 2^-55 (double, 11 terms).
    constexpr int terms = sizeof(S) == 4 ? 5 : 11;
    F sum(static_cast<S>(2.8853900817779268 / (2 * terms - 1)));
    for (int k = terms - 2; k >= 0; --k) sum = sum * s2 + F(static_cast<S>(2.8853900817779268 / (2 * k + 1)));
    return e + s * sum;
}

/// 2^x, 0 below the normal numbers; x <= 126.
template <FloatBatch F>
LANECAST_INLINE F exp2(F x) {
    using S = Scalar<F>;
    constexpr S lowest = sizeof(S) == 4 ? S(-126) : S(-1022);
    const Mask<F> vanishes = x < F(lowest);
    const F clamped = min(max(x, F(lowest)), F(S(126)));
    const F n = round_to_integer(clamped);
    const F f = (clamped - n) * F(static_cast<S>(0.69314718055994531)); // |f| <= ln 2 / 2
    constexpr int terms = sizeof(S) == 4 ? 7 : 13;                      // Taylor: the next term is below 2^-25 and 2^-54
    F sum(S(1));
    for (int k = terms; k >= 1; --k) sum = sum * f * F(static_cast<S>(1.0 / k)) + F(S(1));
    return select(vanishes, F(0), sum * power_of_two(n));
}

/// x^y for 0 <= x and y >= 0 with x^y <= 2^126; x^0 = 1, 0^y = 0. Relative error: at most 4 u (1 + y |ln x|), u = 2^-24, measured in
/// tests/kernels/pow_test.cpp.
template <FloatBatch F>
LANECAST_INLINE F pow(F x, F y) {
    using S = Scalar<F>;
    constexpr S tiny = std::numeric_limits<S>::min();
    const Mask<F> zero = x < F(tiny);
    const F power = exp2(y * log2(max(x, F(tiny))));
    return select(y == F(0), F(1), select(zero, F(0), power));
}

} // namespace lanecast::inline LANECAST_ISA
