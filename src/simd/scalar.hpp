#pragma once
// Batches of width 1: float, the scalar program, and double, the reference. The semantics every wider batch must match, bit
// for bit: min and max return their second argument unless the comparison holds, as the x86 instructions do with NaN.

#include "simd/isa.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace lanecast::inline LANECAST_ISA {

template <class T>
concept ScalarBatch = std::is_same_v<T, float> || std::is_same_v<T, double>;

// Not <bit>: without optimisation its functions are emitted, and the linker would share one ISA's copy with all
// (docs/building.md).
LANECAST_INLINE std::uint32_t count_bits(std::uint64_t b) { return static_cast<std::uint32_t>(__builtin_popcountll(b)); }
/// b is not 0.
LANECAST_INLINE std::uint32_t lowest_bit(std::uint64_t b) { return static_cast<std::uint32_t>(__builtin_ctzll(b)); }

template <class F>
struct BatchTraits;

template <ScalarBatch T>
struct BatchTraits<T> {
    using Scalar = T;
    using Mask = bool;
    using Int = std::int32_t;
    static constexpr int width = 1;
    LANECAST_INLINE static T load(const T* p) { return *p; }
    LANECAST_INLINE static T load_eight(const float* p) { return static_cast<T>(*p); }
    LANECAST_INLINE static std::int32_t load_int(const std::int32_t* p) { return *p; }
    LANECAST_INLINE static bool mask_from_bits(std::uint32_t b) { return (b & 1u) != 0; }
};

template <ScalarBatch T>
LANECAST_INLINE T select(bool mask, T a, T b) {
    return mask ? a : b;
}
LANECAST_INLINE std::int32_t select(bool mask, std::int32_t a, std::int32_t b) { return mask ? a : b; }
template <ScalarBatch T>
LANECAST_INLINE T min(T a, T b) {
    return a < b ? a : b;
}
template <ScalarBatch T>
LANECAST_INLINE T max(T a, T b) {
    return a > b ? a : b;
}
template <ScalarBatch T>
LANECAST_INLINE T abs(T a) {
    return std::fabs(a);
}
template <ScalarBatch T>
LANECAST_INLINE T sqrt(T a) {
    return std::sqrt(a);
}
template <ScalarBatch T>
LANECAST_INLINE T copysign(T magnitude, T sign) {
    return std::copysign(magnitude, sign);
}
/// a * b + c with the product exact: fused on every ISA without the FMA instruction (docs/numerics.md), but in `fast`.
LANECAST_INLINE float fused(float a, float b, float c) {
#if LANECAST_FAST
    return __builtin_fmaf(a, b, c);
#else
    return static_cast<float>(static_cast<double>(a) * static_cast<double>(b) + static_cast<double>(c));
#endif
}
LANECAST_INLINE double fused(double a, double b, double c) { return a * b + c; }
#if LANECAST_FAST
LANECAST_INLINE float fused_less(float c, float a, float b) { return __builtin_fmaf(-a, b, c); }
#endif
/// a2 + b2 + c2 - d2 computed in double and rounded once.
LANECAST_INLINE float sum_of_squares_less(float a, float b, float c, float d) {
    const double x = static_cast<double>(a), y = static_cast<double>(b), z = static_cast<double>(c), w = static_cast<double>(d);
    return static_cast<float>(x * x + y * y + z * z - w * w);
}
LANECAST_INLINE double sum_of_squares_less(double a, double b, double c, double d) { return a * a + b * b + c * c - d * d; }

LANECAST_INLINE bool any(bool m) { return m; }
LANECAST_INLINE bool all(bool m) { return m; }
LANECAST_INLINE bool none(bool m) { return !m; }
LANECAST_INLINE std::uint32_t bits(bool m) { return m ? 1u : 0u; }
template <ScalarBatch T>
LANECAST_INLINE T reduce_min(T a) {
    return a;
}
template <ScalarBatch T>
LANECAST_INLINE T reduce_max(T a) {
    return a;
}

/// x = m * 2^e with m in [sqrt(1/2), sqrt(2)), for normal x > 0.
LANECAST_INLINE float split_exponent(float x, float& e) {
    const std::int32_t i = __builtin_bit_cast(std::int32_t, x) - 0x3f3504f3; // sqrt(1/2)
    e = static_cast<float>(i >> 23);
    return __builtin_bit_cast(float, (i & 0x007fffff) + 0x3f3504f3);
}
LANECAST_INLINE double split_exponent(double x, double& e) {
    const std::int64_t i = __builtin_bit_cast(std::int64_t, x) - 0x3fe6a09e667f3bcd;
    e = static_cast<double>(i >> 52);
    return __builtin_bit_cast(double, (i & 0x000fffffffffffff) + 0x3fe6a09e667f3bcd);
}
/// 2^n for an integral n in the exponent range of normal numbers.
LANECAST_INLINE float power_of_two(float n) { return __builtin_bit_cast(float, (static_cast<std::int32_t>(n) + 127) << 23); }
LANECAST_INLINE double power_of_two(double n) { return __builtin_bit_cast(double, (static_cast<std::int64_t>(n) + 1023) << 52); }
/// i * m + c modulo 2^32.
LANECAST_INLINE std::int32_t multiply_add(std::int32_t i, std::uint32_t m, std::uint32_t c) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(i) * m + c);
}
LANECAST_INLINE float to_float(std::int32_t i) { return static_cast<float>(i); }
LANECAST_INLINE std::int32_t shift_right(std::int32_t i, int n) { return i >> n; }
/// Nearest integer, ties to even, for |x| < 2^22.
LANECAST_INLINE float round_to_integer(float x) {
    const float shift = std::copysign(12582912.0f, x); // 1.5 * 2^23
    return (x + shift) - shift;
}
LANECAST_INLINE double round_to_integer(double x) {
    const double shift = std::copysign(6755399441055744.0, x);
    return (x + shift) - shift;
}

} // namespace lanecast::inline LANECAST_ISA
