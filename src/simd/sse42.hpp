#pragma once
// SSE4.2: 4 lanes.

#include "simd/register_mask.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr int vector_width = 4;
inline constexpr LaneTables<vector_width> lane_tables{};

LANECAST_INLINE __m128i as_int(__m128 r) { return _mm_castps_si128(r); }
LANECAST_INLINE __m128 as_float(__m128i r) { return _mm_castsi128_ps(r); }
LANECAST_INLINE VectorFloat select(VectorMask m, VectorFloat a, VectorFloat b) { return _mm_blendv_ps(b.r, a.r, m.r); }
LANECAST_INLINE VectorInt select(VectorMask m, VectorInt a, VectorInt b) {
    return as_int(select(m, VectorFloat(as_float(a.r)), VectorFloat(as_float(b.r))).r);
}
LANECAST_INLINE std::uint32_t bits(VectorMask m) { return static_cast<std::uint32_t>(_mm_movemask_ps(m.r)); }
LANECAST_INLINE VectorMask mask_from_bits_vector(std::uint32_t b) {
    const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
    return as_float(_mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32(static_cast<int>(b)), lane), lane));
}
LANECAST_INLINE VectorMask operator==(VectorInt a, VectorInt b) { return as_float(_mm_cmpeq_epi32(a.r, b.r)); }
LANECAST_INLINE VectorMask operator>(VectorInt a, VectorInt b) { return as_float(_mm_cmpgt_epi32(a.r, b.r)); }
LANECAST_INLINE VectorInt shift_left(VectorInt a, int n) { return _mm_slli_epi32(a.r, n); }
LANECAST_INLINE VectorInt shift_right(VectorInt a, int n) { return _mm_srai_epi32(a.r, n); }
LANECAST_INLINE VectorFloat to_float(VectorInt a) { return _mm_cvtepi32_ps(a.r); }
LANECAST_INLINE VectorInt to_int(VectorFloat a) { return _mm_cvttps_epi32(a.r); }
LANECAST_INLINE VectorFloat evens(VectorFloat a, VectorFloat b) { return _mm_shuffle_ps(a.r, b.r, 0x88); }
LANECAST_INLINE VectorFloat odds(VectorFloat a, VectorFloat b) { return _mm_shuffle_ps(a.r, b.r, 0xdd); }
LANECAST_INLINE VectorFloat sqrt(VectorFloat a) { return _mm_sqrt_ps(a.r); }
LANECAST_INLINE VectorFloat load_vector(const float* p) { return _mm_loadu_ps(p); }
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

LANECAST_INLINE VectorFloat permute_lanes(VectorFloat a, const std::uint8_t* lanes) {
    std::int32_t four;
    __builtin_memcpy(&four, lanes, 4);
    // lane number -> its four byte numbers
    const __m128i index = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(four));
    const __m128i bytes = _mm_add_epi32(_mm_mullo_epi32(index, _mm_set1_epi32(0x04040404)), _mm_set1_epi32(0x03020100));
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a.r), bytes));
}
LANECAST_INLINE VectorInt permute_lanes(VectorInt a, const std::uint8_t* lanes) {
    return as_int(permute_lanes(VectorFloat(as_float(a.r)), lanes).r);
}

} // namespace lanecast::inline LANECAST_ISA
