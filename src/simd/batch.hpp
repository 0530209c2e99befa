#pragma once
// The one seam to xsimd 8.1.0 and the intrinsics: VectorFloat, VectorMask and VectorInt of this translation unit, with the
// operations that kernels need, equal to scalar.hpp lane by lane; and the same operations over any FloatBatch F.

#include "simd/scalar.hpp"

#if defined(__AVX512F__) && LANECAST_PRECISE
#include "simd/avx512_double.hpp"
#elif defined(__AVX512F__)
#include "simd/avx512.hpp"
#elif defined(__AVX2__) && LANECAST_PRECISE
#include "simd/avx2_double.hpp"
#elif defined(__AVX2__)
#include "simd/avx2.hpp"
#elif LANECAST_VECTOR && LANECAST_PRECISE
#include "simd/sse42_double.hpp"
#elif LANECAST_VECTOR
#include "simd/sse42.hpp"
#endif

namespace lanecast::inline LANECAST_ISA {

#if LANECAST_VECTOR

#if !defined(__AVX512F__)
LANECAST_INLINE VectorFloat compress(VectorFloat a, VectorMask m) { return permute_lanes(a, lane_tables.compress[bits(m)]); }
LANECAST_INLINE VectorInt compress(VectorInt a, VectorMask m) { return permute_lanes(a, lane_tables.compress[bits(m)]); }
LANECAST_INLINE VectorFloat expand(VectorFloat a, VectorMask m) {
    return select(m, permute_lanes(a, lane_tables.expand[bits(m)]), VectorFloat(0));
}
LANECAST_INLINE VectorInt expand(VectorInt a, VectorMask m) {
    return select(m, permute_lanes(a, lane_tables.expand[bits(m)]), VectorInt(0));
}
#endif

template <>
struct BatchTraits<VectorFloat> {
    using Scalar = VectorLane;
    using Mask = VectorMask;
    using Int = VectorInt;
    static constexpr int width = vector_width;
    LANECAST_INLINE static VectorFloat load(const VectorLane* p) { return load_vector(p); }
#if LANECAST_PRECISE
    LANECAST_INLINE static VectorFloat load_eight(const float* p) { return load_floats(p); }
#elif !defined(__AVX512F__)
    LANECAST_INLINE static VectorFloat load_eight(const float* p) { return load_vector(p); }
#endif
    LANECAST_INLINE static VectorInt load_int(const std::int32_t* p) { return load_vector(p); }
    LANECAST_INLINE static VectorMask mask_from_bits(std::uint32_t b) { return mask_from_bits_vector(b); }
};

LANECAST_INLINE VectorInt multiply_add(VectorInt i, std::uint32_t m, std::uint32_t c) {
    return IntRegister(VectorInt::Lanes(i.r) * m + c);
}
LANECAST_INLINE VectorFloat min(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(xsimd::min(VectorFloat::Batch(a.r), VectorFloat::Batch(b.r)));
}
LANECAST_INLINE VectorFloat max(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(xsimd::max(VectorFloat::Batch(a.r), VectorFloat::Batch(b.r)));
}
LANECAST_INLINE VectorFloat abs(VectorFloat a) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) & ~VectorFloat::Batch(VectorLane(-0.0)));
}
LANECAST_INLINE VectorFloat copysign(VectorFloat magnitude, VectorFloat sign) {
    const VectorFloat::Batch sign_bit(VectorLane(-0.0));
    return VectorFloat::Register((VectorFloat::Batch(magnitude.r) & ~sign_bit) | (VectorFloat::Batch(sign.r) & sign_bit));
}
LANECAST_INLINE bool any(VectorMask m) { return bits(m) != 0; }
LANECAST_INLINE bool none(VectorMask m) { return bits(m) == 0; }
LANECAST_INLINE bool all(VectorMask m) { return bits(m) == (1u << vector_width) - 1u; }

#if LANECAST_PRECISE
LANECAST_INLINE VectorFloat fused(VectorFloat a, VectorFloat b, VectorFloat c) { return a * b + c; }
LANECAST_INLINE VectorFloat sum_of_squares_less(VectorFloat a, VectorFloat b, VectorFloat c, VectorFloat d) {
    return a * a + b * b + c * c - d * d;
}
LANECAST_INLINE VectorFloat split_exponent(VectorFloat x, VectorFloat& e) {
    using Longs = xsimd::batch<std::int64_t, Arch>;
    const Longs root_half(0x3fe6a09e667f3bcd);
    const Longs i = Longs(as_int(x.r)) - root_half;
    e = to_float(shift_right(upper_halves(i), 20));
    return as_float((i & Longs(0x000fffffffffffff)) + root_half);
}
LANECAST_INLINE VectorFloat power_of_two(VectorFloat n) {
    const VectorFloat exponent = n + VectorFloat(4503599627370496.0 + 1023); // 2^52 + k has k in its lowest bits
    return as_float(xsimd::batch<std::int64_t, Arch>(as_int(exponent.r)) << 52);
}
#else
#if !LANECAST_FAST
LANECAST_INLINE VectorFloat fused(VectorFloat a, VectorFloat b, VectorFloat c) {
    return to_float(to_double(a) * to_double(b) + to_double(c));
}
#endif
LANECAST_INLINE VectorFloat sum_of_squares_less(VectorFloat a, VectorFloat b, VectorFloat c, VectorFloat d) {
    const Doubles x = to_double(a), y = to_double(b), z = to_double(c), w = to_double(d);
    return to_float(x * x + y * y + z * z - w * w);
}
LANECAST_INLINE VectorFloat split_exponent(VectorFloat x, VectorFloat& e) {
    const VectorInt root_half(0x3f3504f3);
    const VectorInt i = VectorInt(as_int(x.r)) - root_half;
    e = to_float(shift_right(i, 23));
    return as_float(((i & VectorInt(0x007fffff)) + root_half).r);
}
LANECAST_INLINE VectorFloat power_of_two(VectorFloat n) { return as_float(shift_left(to_int(n) + VectorInt(127), 23).r); }
#endif
LANECAST_INLINE VectorFloat round_to_integer(VectorFloat x) {
    const VectorLane mantissa_end =
        LANECAST_PRECISE ? VectorLane(6755399441055744.0) : VectorLane(12582912); // 1.5 * 2^52, 1.5 * 2^23
    const VectorFloat shift = copysign(VectorFloat(mantissa_end), x);
    return (x + shift) - shift;
}

#endif // LANECAST_VECTOR

template <class F>
concept FloatBatch = requires {
    typename BatchTraits<F>::Scalar;
};

/// The batch this translation unit is compiled for.
#if LANECAST_REFERENCE
using NativeFloat = double;
#elif LANECAST_VECTOR
using NativeFloat = VectorFloat;
#else
using NativeFloat = float;
#endif

/// The batch for eight items of the scene, tested at once by one ray or by one packet's bounds: F, or half of it where F is
/// wider.
#if defined(__AVX512F__) && !LANECAST_PRECISE
template <class F>
struct EightOf {
    using Type = F;
};
template <>
struct EightOf<VectorFloat> {
    using Type = EightFloat;
};
template <FloatBatch F>
using Eight = typename EightOf<F>::Type;
#else
template <FloatBatch F>
using Eight = F;
#endif

/// The batch of as many doubles: F itself where it is one.
template <class F>
struct InDouble {
    using Type = std::conditional_t<sizeof(typename BatchTraits<F>::Scalar) == 8, F, double>;
    LANECAST_INLINE static Type splat(double s) { return Type(s); }
    LANECAST_INLINE static Type from(F a) { return static_cast<Type>(a); }
    LANECAST_INLINE static F rounded(Type a) { return static_cast<F>(a); }
};
#if LANECAST_VECTOR && !LANECAST_PRECISE
template <>
struct InDouble<VectorFloat> {
    using Type = Doubles;
    LANECAST_INLINE static Type splat(double s) { return splat_double(s); }
    LANECAST_INLINE static Type from(VectorFloat a) { return to_double(a); }
    LANECAST_INLINE static VectorFloat rounded(Type a) { return to_float(a); }
};
#endif

/// float, or double for `precise` and the reference.
template <FloatBatch F>
using Scalar = typename BatchTraits<F>::Scalar;
template <FloatBatch F>
using Mask = typename BatchTraits<F>::Mask;
template <FloatBatch F>
using Int = typename BatchTraits<F>::Int;
template <FloatBatch F>
inline constexpr int width = BatchTraits<F>::width;
template <FloatBatch F>
inline constexpr std::uint32_t all_lanes = (1u << width<F>)-1u;

template <FloatBatch F>
LANECAST_INLINE F load(const Scalar<F>* p) {
    return BatchTraits<F>::load(p);
}
template <FloatBatch F>
LANECAST_INLINE Int<F> load_int(const std::int32_t* p) {
    return BatchTraits<F>::load_int(p);
}
/// `width` consecutive floats of the scene; F is no wider than 8.
template <FloatBatch F>
LANECAST_INLINE F load_eight(const float* p) {
    return BatchTraits<F>::load_eight(p);
}
template <ScalarBatch T>
LANECAST_INLINE void store(T* p, T a) {
    *p = a;
}
LANECAST_INLINE void store(std::int32_t* p, std::int32_t a) { *p = a; }
LANECAST_INLINE std::int32_t gather(const std::int32_t* p, std::int32_t i) { return p[i]; }

template <FloatBatch F>
LANECAST_INLINE Mask<F> mask_from_bits(std::uint32_t b) {
    return BatchTraits<F>::mask_from_bits(b);
}
/// The first n lanes; n may exceed the width.
template <FloatBatch F>
LANECAST_INLINE Mask<F> first_lanes(std::uint32_t n) {
    return mask_from_bits<F>(n >= static_cast<std::uint32_t>(width<F>) ? all_lanes<F> : (1u << n) - 1u);
}

/// Stores the lanes of `mask` one after the other; writes a whole vector, so p needs width elements of slack.
template <FloatBatch F>
LANECAST_INLINE void compress_store(Scalar<F>* p, F a, Mask<F> mask) {
    if constexpr (ScalarBatch<F>) {
        if (mask) *p = a;
    } else {
        store(p, compress(a, mask));
    }
}
template <FloatBatch F>
LANECAST_INLINE void compress_store_int(std::int32_t* p, Int<F> a, Mask<F> mask) {
    if constexpr (ScalarBatch<F>) {
        if (mask) *p = a;
    } else {
        store(p, compress(a, mask));
    }
}
/// The inverse: the lanes of `mask` take consecutive elements, the others 0. Reads a whole vector.
template <FloatBatch F>
LANECAST_INLINE F expand_load(const Scalar<F>* p, Mask<F> mask) {
    if constexpr (ScalarBatch<F>)
        return mask ? *p : F(0);
    else
        return expand(load<F>(p), mask);
}
template <FloatBatch F>
LANECAST_INLINE Int<F> expand_load_int(const std::int32_t* p, Mask<F> mask) {
    if constexpr (ScalarBatch<F>)
        return mask ? *p : 0;
    else
        return expand(load_int<F>(p), mask);
}

/// Calls body(bit number) for every set bit, lowest first.
template <class Bits, class Body>
LANECAST_INLINE void for_each_bit(Bits b, Body&& body) {
    while (b != 0) {
        body(lowest_bit(b));
        b &= b - 1;
    }
}

/// Runs body(value, lanes) once for every different value among the active lanes: look-ups that differ by lane become uniform.
template <FloatBatch F, class Body>
LANECAST_INLINE void for_each_unique(Int<F> values, Mask<F> active, Body&& body) {
    if constexpr (ScalarBatch<F>) {
        if (active) body(values, active);
    } else {
        alignas(64) std::int32_t lane[width<F>];
        store(lane, values);
        std::uint32_t left = bits(active);
        while (left != 0) {
            const std::int32_t value = lane[lowest_bit(left)];
            const Mask<F> lanes = (values == Int<F>(value)) & mask_from_bits<F>(left);
            body(value, lanes);
            left &= ~bits(lanes);
        }
    }
}

/// Time-stamp counter ticks.
LANECAST_INLINE std::uint64_t ticks() { return __rdtsc(); }

/// Denormals are zero while this lives, in this thread: the same behaviour on every CPU, and no slow path on some.
class FlushDenormals {
public:
    LANECAST_INLINE FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
    LANECAST_INLINE ~FlushDenormals() { _mm_setcsr(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned saved_;
};

} // namespace lanecast::inline LANECAST_ISA
