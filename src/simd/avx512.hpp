#pragma once
// AVX-512 F, BW, DQ, VL, CD: 16 lanes, mask registers.

#include "simd/vector_types.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 16;
struct VectorMask {
    __mmask16 r;
    VectorMask() = default;
    LANECAST_INLINE VectorMask(__mmask16 register_) : r(register_) {}
    LANECAST_INLINE explicit VectorMask(bool b) : r(b ? __mmask16(0xffff) : __mmask16(0)) {}
    // In mask registers: written with & and |, g++ 12 moves every mask to a general register and back.
    LANECAST_INLINE friend VectorMask operator&(VectorMask a, VectorMask b) { return _kand_mask16(a.r, b.r); }
    LANECAST_INLINE friend VectorMask operator|(VectorMask a, VectorMask b) { return _kor_mask16(a.r, b.r); }
    LANECAST_INLINE friend VectorMask operator!(VectorMask a) { return _knot_mask16(a.r); }
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
LANECAST_INLINE __m512i as_int(__m512 r) { return _mm512_castps_si512(r); }
LANECAST_INLINE __m512 as_float(__m512i r) { return _mm512_castsi512_ps(r); }
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return _mm512_cmpeq_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return _mm512_cmpgt_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) { return _mm512_mask_blend_epi32(m.r, b.r, a.r); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm512_slli_epi32(a.r, static_cast<unsigned>(n)); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm512_srai_epi32(a.r, static_cast<unsigned>(n)); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm512_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm512_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm512_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm512_loadu_ps(p); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm512_loadu_si512(p); }
LANECAST_INLINE void store(float* p, VectorFloat a) { _mm512_storeu_ps(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm512_storeu_si512(p, a.r); }
LANECAST_INLINE float reduce_min(VectorFloat a) { return _mm512_reduce_min_ps(a.r); }
LANECAST_INLINE float reduce_max(VectorFloat a) { return _mm512_reduce_max_ps(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) {
    const __m512i lanes = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    return _mm512_permutex2var_ps(a.r, lanes, b.r);
}
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) {
    const __m512i lanes = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    return _mm512_permutex2var_ps(a.r, lanes, b.r);
}
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm512_i32gather_epi32(i.r, p, 4); }
// To a register and then a full store: compressing to memory is microcoded on Zen 4, some 100 cycles.
LANECAST_INLINE VectorFloat compress(VectorFloat a, VectorMask m) { return _mm512_maskz_compress_ps(m.r, a.r); }
LANECAST_INLINE VectorInt compress(VectorInt a, VectorMask m) { return _mm512_maskz_compress_epi32(m.r, a.r); }
LANECAST_INLINE VectorFloat expand(VectorFloat a, VectorMask m) { return _mm512_maskz_expand_ps(m.r, a.r); }
LANECAST_INLINE VectorInt expand(VectorInt a, VectorMask m) { return _mm512_maskz_expand_epi32(m.r, a.r); }

#if LANECAST_FAST
LANECAST_INLINE VectorFloat fused(VectorFloat a, VectorFloat b, VectorFloat c) { return _mm512_fmadd_ps(a.r, b.r, c.r); }
LANECAST_INLINE VectorFloat fused_less(VectorFloat c, VectorFloat a, VectorFloat b) { return _mm512_fnmadd_ps(a.r, b.r, c.r); }
#endif

struct Doubles {
    __m512d lo, hi;
};
LANECAST_INLINE Doubles to_double(VectorFloat a) {
    return {_mm512_cvtps_pd(_mm512_castps512_ps256(a.r)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.r, 1))};
}
LANECAST_INLINE VectorFloat to_float(Doubles a) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.lo)), _mm512_cvtpd_ps(a.hi), 1);
}
LANECAST_INLINE Doubles splat_double(double s) { return {_mm512_set1_pd(s), _mm512_set1_pd(s)}; }
LANECAST_INLINE Doubles operator+(Doubles a, Doubles b) { return {_mm512_add_pd(a.lo, b.lo), _mm512_add_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator-(Doubles a, Doubles b) { return {_mm512_sub_pd(a.lo, b.lo), _mm512_sub_pd(a.hi, b.hi)}; }
LANECAST_INLINE Doubles operator*(Doubles a, Doubles b) { return {_mm512_mul_pd(a.lo, b.lo), _mm512_mul_pd(a.hi, b.hi)}; }

// Half a vector, for the eight children of a node and the eight triangles of a leaf: on Zen 4 a whole one takes twice as long.
struct EightMask {
    __mmask8 r;
    LANECAST_INLINE EightMask(__mmask8 register_) : r(register_) {}
    LANECAST_INLINE friend EightMask operator&(EightMask a, EightMask b) { return _kand_mask8(a.r, b.r); }
    LANECAST_INLINE friend EightMask operator|(EightMask a, EightMask b) { return _kor_mask8(a.r, b.r); }
};
struct EightFloat {
    __m256 r;
    EightFloat() = default;
    LANECAST_INLINE EightFloat(__m256 register_) : r(register_) {}
    LANECAST_INLINE EightFloat(float s) : r(_mm256_set1_ps(s)) {}
    LANECAST_INLINE friend EightFloat operator+(EightFloat a, EightFloat b) { return _mm256_add_ps(a.r, b.r); }
    LANECAST_INLINE friend EightFloat operator-(EightFloat a, EightFloat b) { return _mm256_sub_ps(a.r, b.r); }
    LANECAST_INLINE friend EightFloat operator*(EightFloat a, EightFloat b) { return _mm256_mul_ps(a.r, b.r); }
    LANECAST_INLINE friend EightFloat operator/(EightFloat a, EightFloat b) { return _mm256_div_ps(a.r, b.r); }
    LANECAST_INLINE friend EightMask operator<(EightFloat a, EightFloat b) { return _mm256_cmp_ps_mask(a.r, b.r, _CMP_LT_OQ); }
    LANECAST_INLINE friend EightMask operator>(EightFloat a, EightFloat b) { return _mm256_cmp_ps_mask(a.r, b.r, _CMP_GT_OQ); }
    LANECAST_INLINE friend EightMask operator<=(EightFloat a, EightFloat b) { return _mm256_cmp_ps_mask(a.r, b.r, _CMP_LE_OQ); }
    LANECAST_INLINE friend EightMask operator>=(EightFloat a, EightFloat b) { return _mm256_cmp_ps_mask(a.r, b.r, _CMP_GE_OQ); }
    LANECAST_INLINE friend EightMask operator==(EightFloat a, EightFloat b) { return _mm256_cmp_ps_mask(a.r, b.r, _CMP_EQ_OQ); }
};
#if LANECAST_FAST
LANECAST_INLINE EightFloat fused(EightFloat a, EightFloat b, EightFloat c) { return _mm256_fmadd_ps(a.r, b.r, c.r); }
LANECAST_INLINE EightFloat fused_less(EightFloat c, EightFloat a, EightFloat b) { return _mm256_fnmadd_ps(a.r, b.r, c.r); }
#endif
LANECAST_INLINE EightFloat min(EightFloat a, EightFloat b) { return _mm256_min_ps(a.r, b.r); }
LANECAST_INLINE EightFloat max(EightFloat a, EightFloat b) { return _mm256_max_ps(a.r, b.r); }
LANECAST_INLINE EightFloat abs(EightFloat a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.r); }
LANECAST_INLINE EightFloat copysign(EightFloat magnitude, EightFloat sign) {
    return _mm256_or_ps(abs(magnitude).r, _mm256_and_ps(_mm256_set1_ps(-0.0f), sign.r));
}
LANECAST_INLINE EightFloat select(EightMask m, EightFloat a, EightFloat b) { return _mm256_mask_blend_ps(m.r, b.r, a.r); }
LANECAST_INLINE void store(float* p, EightFloat a) { _mm256_storeu_ps(p, a.r); }
LANECAST_INLINE std::uint32_t bits(EightMask m) { return m.r; }
LANECAST_INLINE bool none(EightMask m) { return m.r == 0; }

template <>
struct BatchTraits<EightFloat> {
    using Scalar = float;
    using Mask = EightMask;
    static constexpr int width = 8;
    LANECAST_INLINE static EightFloat load_eight(const float* p) { return _mm256_loadu_ps(p); }
    LANECAST_INLINE static EightMask mask_from_bits(std::uint32_t b) { return static_cast<__mmask8>(b); }
};

} // namespace lanecast::inline LANECAST_ISA
