#pragma once
// SSE4.2 for `precise`: 2 doubles, 2 integers in half a vector.

#include "simd/register_mask.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 2;
inline constexpr LaneTables<vector_width> lane_tables{};

/// A mask for the integers, and for the doubles.
LANECAST_INLINE __m128i narrow(VectorMask m) { return _mm_shuffle_epi32(_mm_castpd_si128(m.r), 0x88); }
LANECAST_INLINE VectorMask widen(__m128i m) { return _mm_castsi128_pd(_mm_cvtepi32_epi64(m)); }

LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm_blendv_pd(b.r, a.r, m.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) { return _mm_blendv_epi8(b.r, a.r, narrow(m)); }
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm_movemask_pd(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m128i lane = _mm_setr_epi32(1, 2, 0, 0);
    return widen(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(b)), lane), lane));
}
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return widen(_mm_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return widen(_mm_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm_cvtepi32_pd(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) { return _mm_unpacklo_pd(a.r, b.r); }
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) { return _mm_unpackhi_pd(a.r, b.r); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm_sqrt_pd(a.r); }
LANECAST_INLINE VectorFloat load_vector(const double* p) { return _mm_loadu_pd(p); }
LANECAST_INLINE VectorFloat load_floats(const float* p) {
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p))));
}
LANECAST_INLINE VectorInt load_vector(const std::int32_t* p) { return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)); }
LANECAST_INLINE void store(double* p, VectorFloat a) { _mm_storeu_pd(p, a.r); }
LANECAST_INLINE void store(std::int32_t* p, VectorInt a) { _mm_storel_epi64(reinterpret_cast<__m128i*>(p), a.r); }
LANECAST_INLINE double reduce_min(VectorFloat a) { return _mm_cvtsd_f64(_mm_min_sd(a.r, _mm_unpackhi_pd(a.r, a.r))); }
LANECAST_INLINE double reduce_max(VectorFloat a) { return _mm_cvtsd_f64(_mm_max_sd(a.r, _mm_unpackhi_pd(a.r, a.r))); }
LANECAST_INLINE VectorInt gather(const std::int32_t* p, VectorInt i) {
    return _mm_setr_epi32(p[_mm_extract_epi32(i.r, 0)], p[_mm_extract_epi32(i.r, 1)], 0, 0);
}

LANECAST_INLINE VectorFloat permute_lanes(VectorFloat a, const std::uint8_t* lanes) {
    const __m128d first = _mm_unpacklo_pd(a.r, a.r), second = _mm_unpackhi_pd(a.r, a.r);
    return select(mask_from_bits_vector(static_cast<std::uint32_t>(lanes[0] + 2 * lanes[1])), VectorFloat(second),
                  VectorFloat(first));
}
LANECAST_INLINE VectorInt permute_lanes(VectorInt a, const std::uint8_t* lanes) {
    return _mm_setr_epi32(lanes[0] != 0 ? _mm_extract_epi32(a.r, 1) : _mm_extract_epi32(a.r, 0),
                          lanes[1] != 0 ? _mm_extract_epi32(a.r, 1) : _mm_extract_epi32(a.r, 0), 0, 0);
}

LANECAST_INLINE __m128i as_int(__m128d r) { return _mm_castpd_si128(r); }
LANECAST_INLINE __m128d as_float(__m128i r) { return _mm_castsi128_pd(r); }
/// The upper halves of the lanes.
LANECAST_INLINE VectorInt upper_halves(__m128i a) { return _mm_shuffle_epi32(a, 0xdd); }

} // namespace lanecast::inline LANECAST_ISA
