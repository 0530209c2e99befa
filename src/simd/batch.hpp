#pragma once
// The one seam to xsimd 8.1.0 and the intrinsics: Float, Mask and Int of this translation unit's width, with the operations
// that kernels need, equal to scalar.hpp lane by lane. Own types rather than xsimd's, because xsimd 8.1 lacks mask bits,
// compression and int/float selection, and so that no xsimd function is found by argument-dependent look-up.

#include "simd/scalar.hpp"

namespace lanecast::inline LANECAST_ISA {

#if LANECAST_VECTOR

struct VectorMask;
struct VectorInt;

struct VectorFloat {
    using Batch = xsimd::batch<float, Arch>;
    using Register = Batch::register_type;
    Register r;

    VectorFloat() = default;
    LANECAST_INLINE VectorFloat(Register register_) : r(register_) {}
    LANECAST_INLINE VectorFloat(float s) : r(Batch(s)) {}
    LANECAST_INLINE friend VectorFloat operator+(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) + Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) - Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator*(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) * Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator/(VectorFloat a, VectorFloat b) { return Register(Batch(a.r) / Batch(b.r)); }
    LANECAST_INLINE friend VectorFloat operator-(VectorFloat a) { return Register(Batch(a.r) ^ Batch(-0.0f)); }
    LANECAST_INLINE VectorFloat& operator+=(VectorFloat b) { return *this = *this + b; }
};

#if defined(__AVX512F__)
inline constexpr int vector_width = 16;
struct VectorMask {
    __mmask16 r;
    VectorMask() = default;
    LANECAST_INLINE VectorMask(__mmask16 register_) : r(register_) {}
    LANECAST_INLINE explicit VectorMask(bool b) : r(b ? __mmask16(0xffff) : __mmask16(0)) {}
    LANECAST_INLINE friend VectorMask operator&(VectorMask a, VectorMask b) { return __mmask16(a.r & b.r); }
    LANECAST_INLINE friend VectorMask operator|(VectorMask a, VectorMask b) { return __mmask16(a.r | b.r); }
    LANECAST_INLINE friend VectorMask operator!(VectorMask a) { return __mmask16(~a.r); }
};
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return m.r; }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) { return __mmask16(b); }
LANECAST_INLINE VectorMask operator<(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_LT_OQ); }
LANECAST_INLINE VectorMask operator<=(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_LE_OQ); }
LANECAST_INLINE VectorMask operator>(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_GT_OQ); }
LANECAST_INLINE VectorMask operator>=(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_GE_OQ); }
LANECAST_INLINE VectorMask operator==(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_EQ_OQ); }
LANECAST_INLINE VectorMask operator!=(VectorFloat a, VectorFloat b) { return _mm512_cmp_ps_mask(a.r, b.r, _CMP_NEQ_UQ); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm512_mask_blend_ps(m.r, b.r, a.r); }
#elif defined(__AVX2__)
inline constexpr int vector_width = 8;
#else
inline constexpr int vector_width = 4;
#endif

#if !defined(__AVX512F__)
struct VectorMask {
    using Register = VectorFloat::Register;
    Register r;
    VectorMask() = default;
    LANECAST_INLINE VectorMask(Register register_) : r(register_) {}
    LANECAST_INLINE explicit VectorMask(bool b) : r(xsimd::batch_bool<float, Arch>(b)) {}
    LANECAST_INLINE friend VectorMask operator&(VectorMask a, VectorMask b) {
        return Register(VectorFloat::Batch(a.r) & VectorFloat::Batch(b.r));
    }
    LANECAST_INLINE friend VectorMask operator|(VectorMask a, VectorMask b) {
        return Register(VectorFloat::Batch(a.r) | VectorFloat::Batch(b.r));
    }
    LANECAST_INLINE friend VectorMask operator!(VectorMask a) { return Register(~VectorFloat::Batch(a.r)); }
};
LANECAST_INLINE VectorMask operator<(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) < VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator<=(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) <= VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator>(VectorFloat a, VectorFloat b) { return b < a; }
LANECAST_INLINE VectorMask operator>=(VectorFloat a, VectorFloat b) { return b <= a; }
LANECAST_INLINE VectorMask operator==(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) == VectorFloat::Batch(b.r));
}
LANECAST_INLINE VectorMask operator!=(VectorFloat a, VectorFloat b) { return !(a == b); }
#endif

#if defined(__AVX512F__)
using IntRegister = __m512i;
LANECAST_INLINE __m512i as_int(__m512 r) { return _mm512_castps_si512(r); }
LANECAST_INLINE __m512 as_float(__m512i r) { return _mm512_castsi512_ps(r); }
#elif defined(__AVX2__)
using IntRegister = __m256i;
LANECAST_INLINE __m256i as_int(__m256 r) { return _mm256_castps_si256(r); }
LANECAST_INLINE __m256 as_float(__m256i r) { return _mm256_castsi256_ps(r); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm256_blendv_ps(b.r, a.r, m.r); }
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return as_float(_mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(b)), lane), lane));
}
#else
using IntRegister = __m128i;
LANECAST_INLINE __m128i as_int(__m128 r) { return _mm_castps_si128(r); }
LANECAST_INLINE __m128 as_float(__m128i r) { return _mm_castsi128_ps(r); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm_blendv_ps(b.r, a.r, m.r); }
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm_movemask_ps(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    return as_float(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(b)), lane), lane));
}
#endif

struct VectorInt {
    using Batch = xsimd::batch<std::int32_t, Arch>;
    IntRegister r;
    VectorInt() = default;
    LANECAST_INLINE VectorInt(IntRegister register_) : r(register_) {}
    LANECAST_INLINE VectorInt(std::int32_t s) : r(Batch(s)) {}
    LANECAST_INLINE friend VectorInt operator+(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) + Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator-(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) - Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator&(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) & Batch(b.r)); }
    LANECAST_INLINE friend VectorInt operator|(VectorInt a, VectorInt b) { return IntRegister(Batch(a.r) | Batch(b.r)); }
};
#if defined(__AVX512F__)
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return _mm512_cmpeq_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return _mm512_cmpgt_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) { return _mm512_mask_blend_epi32(m.r, b.r, a.r); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm512_slli_epi32(a.r, static_cast<unsigned>(n)); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm512_srai_epi32(a.r, static_cast<unsigned>(n)); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm512_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm512_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm512_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm512_loadu_ps(p); }
LANECAST_INLINE VectorFloat load_eight_vector(const float* p) { return _mm512_maskz_loadu_ps(0xff, p); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm512_loadu_si512(p); }
LANECAST_INLINE void store(float* p, VectorFloat a) { _mm512_storeu_ps(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm512_storeu_si512(p, a.r); }
LANECAST_INLINE float reduce_min(VectorFloat a) { return _mm512_reduce_min_ps(a.r); }
LANECAST_INLINE float reduce_max(VectorFloat a) { return _mm512_reduce_max_ps(a.r); }
LANECAST_INLINE VectorFloat gather(const float* p, VectorInt i) { return _mm512_i32gather_ps(i.r, p, 4); }
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm512_i32gather_epi32(i.r, p, 4); }
// To a register and then a full store: compressing to memory is microcoded on Zen 4, some 100 cycles.
LANECAST_INLINE VectorFloat compress(VectorFloat a, VectorMask m) { return _mm512_maskz_compress_ps(m.r, a.r); }
LANECAST_INLINE VectorInt compress(VectorInt a, VectorMask m) { return _mm512_maskz_compress_epi32(m.r, a.r); }
LANECAST_INLINE VectorFloat expand(VectorFloat a, VectorMask m) { return _mm512_maskz_expand_ps(m.r, a.r); }
LANECAST_INLINE VectorInt expand(VectorInt a, VectorMask m) { return _mm512_maskz_expand_epi32(m.r, a.r); }

struct Doubles {
    __m512d lo, hi;
};
LANECAST_INLINE Doubles to_double(VectorFloat a) {
    return {_mm512_cvtps_pd(_mm512_castps512_ps256(a.r)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.r, 1))};
}
LANECAST_INLINE VectorFloat to_float(Doubles a) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.lo)), _mm512_cvtpd_ps(a.hi), 1);
}
LANECAST_INLINE Doubles operator+(Doubles a, Doubles b) { return {_mm512_add_pd(a.lo, b.lo), _mm512_add_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator-(Doubles a, Doubles b) { return {_mm512_sub_pd(a.lo, b.lo), _mm512_sub_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator*(Doubles a, Doubles b) { return {_mm512_mul_pd(a.lo, b.lo), _mm512_mul_pd(a.hi, b.hi)}; }
#elif defined(__AVX2__)
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return as_float(_mm256_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return as_float(_mm256_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm256_slli_epi32(a.r, n); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm256_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm256_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm256_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm256_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm256_loadu_ps(p); }
LANECAST_INLINE VectorFloat load_eight_vector(const float* p) { return _mm256_loadu_ps(p); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
LANECAST_INLINE void store(float* p, VectorFloat a) { _mm256_storeu_ps(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.r); }
LANECAST_INLINE float reduce_min(VectorFloat a) {
    __m128 x = _mm_min_ps(_mm256_castps256_ps128(a.r), _mm256_extractf128_ps(a.r, 1));
    x = _mm_min_ps(x, _mm_movehl_ps(x, x));
    return _mm_cvtss_f32(_mm_min_ss(x, _mm_movehdup_ps(x)));
}
LANECAST_INLINE float reduce_max(VectorFloat a) {
    __m128 x = _mm_max_ps(_mm256_castps256_ps128(a.r), _mm256_extractf128_ps(a.r, 1));
    x = _mm_max_ps(x, _mm_movehl_ps(x, x));
    return _mm_cvtss_f32(_mm_max_ss(x, _mm_movehdup_ps(x)));
}
LANECAST_INLINE VectorFloat gather(const float* p, VectorInt i) { return _mm256_i32gather_ps(p, i.r, 4); }
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm256_i32gather_epi32(p, i.r, 4); }

struct Doubles {
    __m256d lo, hi;
};
LANECAST_INLINE Doubles to_double(VectorFloat a) {
    return {_mm256_cvtps_pd(_mm256_castps256_ps128(a.r)), _mm256_cvtps_pd(_mm256_extractf128_ps(a.r, 1))};
}
LANECAST_INLINE VectorFloat to_float(Doubles a) { return _mm256_set_m128(_mm256_cvtpd_ps(a.hi), _mm256_cvtpd_ps(a.lo)); }
LANECAST_INLINE Doubles operator+(Doubles a, Doubles b) { return {_mm256_add_pd(a.lo, b.lo), _mm256_add_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator-(Doubles a, Doubles b) { return {_mm256_sub_pd(a.lo, b.lo), _mm256_sub_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator*(Doubles a, Doubles b) { return {_mm256_mul_pd(a.lo, b.lo), _mm256_mul_pd(a.hi, b.hi)}; }
#else
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return as_float(_mm_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return as_float(_mm_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm_slli_epi32(a.r, n); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm_loadu_ps(p); }
LANECAST_INLINE VectorFloat load_eight_vector(const float* p) { return _mm_loadu_ps(p); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
LANECAST_INLINE void store(float* p, VectorFloat a) { _mm_storeu_ps(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.r); }
LANECAST_INLINE float reduce_min(VectorFloat a) {
    const __m128 x = _mm_min_ps(a.r, _mm_movehl_ps(a.r, a.r));
    return _mm_cvtss_f32(_mm_min_ss(x, _mm_movehdup_ps(x)));
}
LANECAST_INLINE float reduce_max(VectorFloat a) {
    const __m128 x = _mm_max_ps(a.r, _mm_movehl_ps(a.r, a.r));
    return _mm_cvtss_f32(_mm_max_ss(x, _mm_movehdup_ps(x)));
}
LANECAST_INLINE VectorFloat gather(const float* p, VectorInt i) {
    alignas(16) std::int32_t index[4];
    store(index, i);
    return _mm_setr_ps(p[index[0]], p[index[1]], p[index[2]], p[index[3]]);
}
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) {
    alignas(16) std::int32_t index[4];
    store(index, i);
    return _mm_setr_epi32(p[index[0]], p[index[1]], p[index[2]], p[index[3]]);
}

struct Doubles {
    __m128d lo, hi;
};
LANECAST_INLINE Doubles to_double(VectorFloat a) { return {_mm_cvtps_pd(a.r), _mm_cvtps_pd(_mm_movehl_ps(a.r, a.r))}; }
LANECAST_INLINE VectorFloat to_float(Doubles a) { return _mm_movelh_ps(_mm_cvtpd_ps(a.lo), _mm_cvtpd_ps(a.hi)); }
LANECAST_INLINE Doubles operator+(Doubles a, Doubles b) { return {_mm_add_pd(a.lo, b.lo), _mm_add_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator-(Doubles a, Doubles b) { return {_mm_sub_pd(a.lo, b.lo), _mm_sub_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator*(Doubles a, Doubles b) { return {_mm_mul_pd(a.lo, b.lo), _mm_mul_pd(a.hi, b.hi)}; }
#endif

#if !defined(__AVX512F__)
// Byte shuffles that move the lanes of a mask to the front, and back. Built by the compiler: no code runs for them.
template <int Lanes>
struct LaneTables {
    std::uint8_t compress[1 << Lanes][Lanes]{};
    std::uint8_t expand[1 << Lanes][Lanes]{};
    constexpr LaneTables() {
        for (int m = 0; m < (1 << Lanes); ++m) {
            int n = 0;
            for (int lane = 0; lane < Lanes; ++lane) {
                if (((m >> lane) & 1) == 0) continue;
                compress[m][n] = static_cast<std::uint8_t>(lane);
                expand[m][lane] = static_cast<std::uint8_t>(n);
                ++n;
            }
        }
    }
};
inline constexpr LaneTables<vector_width> lane_tables{};

#if defined(__AVX2__)
LANECAST_INLINE __m256 permute_lanes(__m256 a, const std::uint8_t* lanes) {
    const __m256i index = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes)));
    return _mm256_permutevar8x32_ps(a, index);
}
#else
LANECAST_INLINE __m128 permute_lanes(__m128 a, const std::uint8_t* lanes) {
    std::int32_t four;
    __builtin_memcpy(&four, lanes, 4);
    // lane number -> its four byte numbers
    const __m128i index = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(four));
    const __m128i bytes = _mm_add_epi32(_mm_mullo_epi32(index, _mm_set1_epi32(0x04040404)), _mm_set1_epi32(0x03020100));
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), bytes));
}
#endif
LANECAST_INLINE VectorFloat compress(VectorFloat a, VectorMask m) { return permute_lanes(a.r, lane_tables.compress[bits(m)]); }
LANECAST_INLINE VectorInt compress(VectorInt a, VectorMask m) {
    return as_int(permute_lanes(as_float(a.r), lane_tables.compress[bits(m)]));
}
LANECAST_INLINE VectorFloat expand(VectorFloat a, VectorMask m) {
    return select(m, VectorFloat(permute_lanes(a.r, lane_tables.expand[bits(m)])), VectorFloat(0.0f));
}
LANECAST_INLINE VectorInt expand(VectorInt a, VectorMask m) {
    const VectorFloat moved = permute_lanes(as_float(a.r), lane_tables.expand[bits(m)]);
    return as_int(select(m, moved, VectorFloat(0.0f)).r);
}
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) {
    return as_int(select(m, VectorFloat(as_float(a.r)), VectorFloat(as_float(b.r))).r);
}
#endif

template <>
struct BatchTraits<VectorFloat> {
    using Scalar = float;
    using Mask = VectorMask;
    using Int = VectorInt;
    static constexpr int width = vector_width;
    LANECAST_INLINE static VectorFloat load(const float* p) { return load_vector(p); }
    LANECAST_INLINE static VectorFloat load_eight(const float* p) { return load_eight_vector(p); }
    LANECAST_INLINE static VectorInt load_int(const std::int32_t* p) { return load_vector(p); }
    LANECAST_INLINE static VectorMask mask_from_bits(std::uint32_t b) { return mask_from_bits_vector(b); }
};

LANECAST_INLINE VectorInt multiply_add(VectorInt i, std::uint32_t m, std::uint32_t c) {
    using Batch = VectorInt::Batch;
    return IntRegister(Batch(i.r) * Batch(static_cast<std::int32_t>(m)) + Batch(static_cast<std::int32_t>(c)));
}
LANECAST_INLINE VectorFloat min(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(xsimd::min(VectorFloat::Batch(a.r), VectorFloat::Batch(b.r)));
}
LANECAST_INLINE VectorFloat max(VectorFloat a, VectorFloat b) {
    return VectorFloat::Register(xsimd::max(VectorFloat::Batch(a.r), VectorFloat::Batch(b.r)));
}
LANECAST_INLINE VectorFloat abs(VectorFloat a) {
    return VectorFloat::Register(VectorFloat::Batch(a.r) & ~VectorFloat::Batch(-0.0f));
}
LANECAST_INLINE VectorFloat copysign(VectorFloat magnitude, VectorFloat sign) {
    const VectorFloat::Batch sign_bit(-0.0f);
    return VectorFloat::Register((VectorFloat::Batch(magnitude.r) & ~sign_bit) | (VectorFloat::Batch(sign.r) & sign_bit));
}
LANECAST_INLINE VectorFloat fused(VectorFloat a, VectorFloat b, VectorFloat c) {
    return to_float(to_double(a) * to_double(b) + to_double(c));
}
LANECAST_INLINE VectorFloat sum_of_squares_less(VectorFloat a, VectorFloat b, VectorFloat c, VectorFloat d) {
    const Doubles x = to_double(a), y = to_double(b), z = to_double(c), w = to_double(d);
    return to_float(x * x + y * y + z * z - w * w);
}
LANECAST_INLINE bool any(VectorMask m) { return bits(m) != 0; }
LANECAST_INLINE bool none(VectorMask m) { return bits(m) == 0; }
LANECAST_INLINE bool all(VectorMask m) { return bits(m) == (1u << vector_width) - 1u; }

LANECAST_INLINE VectorFloat split_exponent(VectorFloat x, VectorFloat& e) {
    const VectorInt root_half(0x3f3504f3);
    const VectorInt i = VectorInt(as_int(x.r)) - root_half;
    e = to_float(shift_right(i, 23));
    return as_float(((i & VectorInt(0x007fffff)) + root_half).r);
}
LANECAST_INLINE VectorFloat power_of_two(VectorFloat n) { return as_float(shift_left(to_int(n) + VectorInt(127), 23).r); }
LANECAST_INLINE VectorFloat round_to_integer(VectorFloat x) {
    const VectorFloat shift = copysign(VectorFloat(12582912.0f), x);
    return (x + shift) - shift;
}

#endif // LANECAST_VECTOR

template <class F>
concept FloatBatch = requires { typename BatchTraits<F>::Scalar; };

/// float for every float batch, double for the reference.
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
/// min(width, 8) consecutive floats of the scene; wider batches hold 0 beyond.
template <FloatBatch F>
LANECAST_INLINE F load_eight(const float* p) {
    return BatchTraits<F>::load_eight(p);
}
template <ScalarBatch T>
LANECAST_INLINE void store(T* p, T a) {
    *p = a;
}
LANECAST_INLINE void store(std::int32_t* p, std::int32_t a) { *p = a; }
template <ScalarBatch T>
LANECAST_INLINE T gather(const T* p, std::int32_t i) {
    return p[i];
}
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
template <class Body>
LANECAST_INLINE void for_each_bit(std::uint32_t b, Body&& body) {
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
