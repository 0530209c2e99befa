#pragma once
// Three batches: points, directions, colours.

#include "simd/arithmetic.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
struct Vec3 {
    F x, y, z;

    LANECAST_INLINE friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    LANECAST_INLINE friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    LANECAST_INLINE friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    LANECAST_INLINE friend Vec3 operator*(const Vec3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
    LANECAST_INLINE friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
};

template <FloatBatch F>
LANECAST_INLINE F dot(const Vec3<F>& a, const Vec3<F>& b) {
    return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
template <FloatBatch F>
LANECAST_INLINE Vec3<F> abs(const Vec3<F>& a) {
    return {abs(a.x), abs(a.y), abs(a.z)};
}
template <FloatBatch F>
LANECAST_INLINE F length(const Vec3<F>& a) {
    return sqrt(dot(a, a));
}
template <FloatBatch F>
LANECAST_INLINE Vec3<F> normalize(const Vec3<F>& a) {
    return a * (F(1) / length(a));
}
template <FloatBatch F>
LANECAST_INLINE Vec3<F> select(Mask<F> mask, const Vec3<F>& a, const Vec3<F>& b) {
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}
/// The same point or colour of the scene in every lane.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> splat(const float (&v)[3]) {
    using S = Scalar<F>;
    return {F(static_cast<S>(v[0])), F(static_cast<S>(v[1])), F(static_cast<S>(v[2]))};
}
/// Component-wise fused(d, t, f): f + t d with one rounding.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> fused(const Vec3<F>& d, F t, const Vec3<F>& f) {
    return {fused(d.x, t, f.x), fused(d.y, t, f.y), fused(d.z, t, f.z)};
}

/// Three arrays that hold one Vec3 per ray.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> load(Scalar<F>* const (&p)[3], std::uint32_t i) {
    return {load<F>(p[0] + i), load<F>(p[1] + i), load<F>(p[2] + i)};
}
template <FloatBatch F>
LANECAST_INLINE void store(Scalar<F>* const (&p)[3], std::uint32_t i, const Vec3<F>& v) {
    store(p[0] + i, v.x);
    store(p[1] + i, v.y);
    store(p[2] + i, v.z);
}

} // namespace lanecast::inline LANECAST_ISA
