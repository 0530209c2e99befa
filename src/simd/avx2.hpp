#pragma once
// AVX2: 8 lanes.

#include "simd/register_mask.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 8;
inline constexpr LaneTables<vector_width> lane_tables{};

LANECAST_INLINE __m256i as_int(__m256 r) { return _mm256_castps_si256(r); }
LANECAST_INLINE __m256 as_float(__m256i r) { return _mm256_castsi256_ps(r); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm256_blendv_ps(b.r, a.r, m.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) {
    return as_int(select(m, VectorFloat(as_float(a.r)), VectorFloat(as_float(b.r))).r);
}
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    return as_float(_mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(static_cast<int>(b)), lane), lane));
}
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return as_float(_mm256_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return as_float(_mm256_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm256_slli_epi32(a.r, n); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm256_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm256_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm256_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) {
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(_mm256_shuffle_ps(a.r, b.r, 0x88)), 0xd8));
}
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) {
    return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(_mm256_shuffle_ps(a.r, b.r, 0xdd)), 0xd8));
}
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm256_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm256_loadu_ps(p); }
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
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm256_i32gather_epi32(p, i.r, 4); }

#if LANECAST_FAST
LANECAST_INLINE VectorFloat fused(VectorFloat a, VectorFloat b, VectorFloat c) { return _mm256_fmadd_ps(a.r, b.r, c.r); }
LANECAST_INLINE VectorFloat fused_less(VectorFloat c, VectorFloat a, VectorFloat b) { return _mm256_fnmadd_ps(a.r, b.r, c.r); }
#endif

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

LANECAST_INLINE VectorFloat permute_lanes(VectorFloat a, const std::uint8_t* lanes) {
    const __m256i index = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(lanes)));
    return _mm256_permutevar8x32_ps(a.r, index);
}
LANECAST_INLINE VectorInt permute_lanes(VectorInt a, const std::uint8_t* lanes) {
    return as_int(permute_lanes(VectorFloat(as_float(a.r)), lanes).r);
}

} // namespace lanecast::inline LANECAST_ISA
