#pragma once
// AVX-512 for `precise`: 8 doubles, mask registers, 8 integers in half a vector.

#include "simd/vector_types.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 8;
struct VectorMask {
    __mmask8 r;
    VectorMask() = default;
    LANECAST_INLINE VectorMask(__mmask8 register_) : r(register_) {}
    LANECAST_INLINE explicit VectorMask(bool b) : r(b ? __mmask8(0xff) : __mmask8(0)) {}
    LANECAST_INLINE friend VectorMask operator&(VectorMask a, VectorMask b) { return _kand_mask8(a.r, b.r); }
    LANECAST_INLINE friend VectorMask operator|(VectorMask a, VectorMask b) { return _kor_mask8(a.r, b.r); }
    LANECAST_INLINE friend VectorMask operator!(VectorMask a) { return _knot_mask8(a.r); }
};
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return m.r; }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) { return __mmask8(b); }
LANECAST_INLINE VectorMask operator<(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_LT_OQ); }
LANECAST_INLINE VectorMask operator<=(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_LE_OQ); }
LANECAST_INLINE VectorMask operator>(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_GT_OQ); }
LANECAST_INLINE VectorMask operator>=(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_GE_OQ); }
LANECAST_INLINE VectorMask operator==(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_EQ_OQ); }
LANECAST_INLINE VectorMask operator!=(VectorFloat a, VectorFloat b) { return _mm512_cmp_pd_mask(a.r, b.r, _CMP_NEQ_UQ); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm512_mask_blend_pd(m.r, b.r, a.r); }
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return _mm256_cmpeq_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return _mm256_cmpgt_epi32_mask(a.r, b.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) { return _mm256_mask_blend_epi32(m.r, b.r, a.r); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm256_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm512_cvtepi32_pd(a.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm512_sqrt_pd(a.r); }
LANECAST_INLINE VectorFloat load_vector(const double* p) { return _mm512_loadu_pd(p); }
LANECAST_INLINE VectorFloat load_floats(const float* p) { return _mm512_cvtps_pd(_mm256_loadu_ps(p)); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
LANECAST_INLINE void store(double* p, VectorFloat a) { _mm512_storeu_pd(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.r); }
LANECAST_INLINE double reduce_min(VectorFloat a) { return _mm512_reduce_min_pd(a.r); }
LANECAST_INLINE double reduce_max(VectorFloat a) { return _mm512_reduce_max_pd(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) {
    return _mm512_permutex2var_pd(a.r, _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), b.r);
}
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) {
    return _mm512_permutex2var_pd(a.r, _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), b.r);
}
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm256_i32gather_epi32(p, i.r, 4); }
LANECAST_INLINE VectorFloat compress(VectorFloat a, VectorMask m) { return _mm512_maskz_compress_pd(m.r, a.r); }
LANECAST_INLINE VectorInt compress(VectorInt a, VectorMask m) { return _mm256_maskz_compress_epi32(m.r, a.r); }
LANECAST_INLINE VectorFloat expand(VectorFloat a, VectorMask m) { return _mm512_maskz_expand_pd(m.r, a.r); }
LANECAST_INLINE VectorInt expand(VectorInt a, VectorMask m) { return _mm256_maskz_expand_epi32(m.r, a.r); }

LANECAST_INLINE __m512i as_int(__m512d r) { return _mm512_castpd_si512(r); }
LANECAST_INLINE __m512d as_float(__m512i r) { return _mm512_castsi512_pd(r); }
/// The upper halves of the lanes.
LANECAST_INLINE VectorInt upper_halves(__m512i a) { return _mm512_cvtepi64_epi32(_mm512_srli_epi64(a, 32)); }

} // namespace lanecast::inline LANECAST_ISA
