#pragma once
// Three batches of doubles, where the rounding of a float would show: few operations, no comparisons.

#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
struct DoubleVec3 {
    using D = InDouble<F>;
    using Type = typename D::Type;
    Type x, y, z;

    LANECAST_INLINE static DoubleVec3 from(const Vec3<F>& v) { return {D::from(v.x), D::from(v.y), D::from(v.z)}; }
    LANECAST_INLINE static DoubleVec3 splat(const float (&v)[3]) {
        return {D::splat(double{v[0]}), D::splat(double{v[1]}), D::splat(double{v[2]})};
    }
    /// Each component once.
    [[nodiscard]] LANECAST_INLINE Vec3<F> rounded() const { return {D::rounded(x), D::rounded(y), D::rounded(z)}; }

    LANECAST_INLINE friend DoubleVec3 operator+(const DoubleVec3& a, const DoubleVec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    LANECAST_INLINE friend DoubleVec3 operator-(const DoubleVec3& a, const DoubleVec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    LANECAST_INLINE friend DoubleVec3 operator*(const DoubleVec3& a, Type s) { return {a.x * s, a.y * s, a.z * s}; }
    LANECAST_INLINE friend Type dot(const DoubleVec3& a, const DoubleVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    LANECAST_INLINE friend DoubleVec3 cross(const DoubleVec3& a, const DoubleVec3& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};

} // namespace lanecast::inline LANECAST_ISA
