#pragma once
// AVX2 for `precise`: 4 doubles, 4 integers in half a vector.

#include "simd/register_mask.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 4;
inline constexpr LaneTables<vector_width> lane_tables{};

/// A mask for the integers, and for the doubles.
LANECAST_INLINE __m128i narrow(VectorMask m) {
    const __m256 lanes = _mm256_castpd_ps(m.r);
    return _mm_castps_si128(_mm_shuffle_ps(_mm256_castps256_ps128(lanes), _mm256_extractf128_ps(lanes, 1), 0x88));
}
LANECAST_INLINE VectorMask widen(__m128i m) { return _mm256_castsi256_pd(_mm256_cvtepi32_epi64(m)); }

LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm256_blendv_pd(b.r, a.r, m.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) { return _mm_blendv_epi8(b.r, a.r, narrow(m)); }
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm256_movemask_pd(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    return widen(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(b)), lane), lane));
}
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return widen(_mm_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return widen(_mm_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm256_cvtepi32_pd(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) {
    return _mm256_permute4x64_pd(_mm256_unpacklo_pd(a.r, b.r), 0xd8);
}
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) {
    return _mm256_permute4x64_pd(_mm256_unpackhi_pd(a.r, b.r), 0xd8);
}
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm256_sqrt_pd(a.r); }
LANECAST_INLINE VectorFloat load_vector(const double* p) { return _mm256_loadu_pd(p); }
LANECAST_INLINE VectorFloat load_floats(const float* p) { return _mm256_cvtps_pd(_mm_loadu_ps(p)); }
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p)); }
LANECAST_INLINE void store(double* p, VectorFloat a) { _mm256_storeu_pd(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), a.r); }
LANECAST_INLINE double reduce_min(VectorFloat a) {
    const __m128d x = _mm_min_pd(_mm256_castpd256_pd128(a.r), _mm256_extractf128_pd(a.r, 1));
    return _mm_cvtsd_f64(_mm_min_sd(x, _mm_unpackhi_pd(x, x)));
}
LANECAST_INLINE double reduce_max(VectorFloat a) {
    const __m128d x = _mm_max_pd(_mm256_castpd256_pd128(a.r), _mm256_extractf128_pd(a.r, 1));
    return _mm_cvtsd_f64(_mm_max_sd(x, _mm_unpackhi_pd(x, x)));
}
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) { return _mm_i32gather_epi32(p, i.r, 4); }

LANECAST_INLINE VectorFloat permute_lanes(VectorFloat a, const std::uint8_t* lanes) {
    std::int32_t four;
    __builtin_memcpy(&four, lanes, 4);
    // lane number -> those of its two halves
    const __m256i index = _mm256_cvtepu8_epi64(_mm_cvtsi32_si128(four));
    const __m256i halves = _mm256_or_si256(_mm256_slli_epi64(index, 1), _mm256_slli_epi64(index, 33));
    const __m256i pairs = _mm256_add_epi32(halves, _mm256_setr_epi32(0, 1, 0, 1, 0, 1, 0, 1));
    return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(a.r), pairs));
}
LANECAST_INLINE VectorInt permute_lanes(VectorInt a, const std::uint8_t* lanes) {
    std::int32_t four;
    __builtin_memcpy(&four, lanes, 4);
    return _mm_castps_si128(_mm_permutevar_ps(_mm_castsi128_ps(a.r), _mm_cvtepu8_epi32(_mm_cvtsi32_si128(four))));
}

LANECAST_INLINE __m256i as_int(__m256d r) { return _mm256_castpd_si256(r); }
LANECAST_INLINE __m256d as_float(__m256i r) { return _mm256_castsi256_pd(r); }
/// The upper halves of the lanes.
LANECAST_INLINE VectorInt upper_halves(__m256i a) {
    return _mm_castps_si128(
        _mm_shuffle_ps(_mm_castsi128_ps(_mm256_castsi256_si128(a)), _mm_castsi128_ps(_mm256_extracti128_si256(a, 1)), 0xdd));
}

} // namespace lanecast::inline LANECAST_ISA
