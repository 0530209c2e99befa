#pragma once
// Where rays meet things, in 64 bits of mantissa and by other formulas than the kernels', for the very floats that they read.

#include "cli/selftest/rays.hpp"

namespace lanecast::selftest {

using Real = long double;

struct RealVec {
    Real x, y, z;
};
[[nodiscard]] inline RealVec operator-(const RealVec& a, const RealVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
[[nodiscard]] inline RealVec operator+(const RealVec& a, const RealVec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
[[nodiscard]] inline RealVec operator*(const RealVec& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
[[nodiscard]] inline Real dot(const RealVec& a, const RealVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] inline RealVec cross(const RealVec& a, const RealVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] Real length(const RealVec& a);
[[nodiscard]] inline RealVec real(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// The way of a ray through a sphere around the origin, or around the y axis where y is 0 throughout.
struct RealCrossing {
    bool hit;
    Real t0, t1;
    Real gap;    ///< (radius - closest approach) / radius: negative for a miss
    Real cosine; ///< of the angle to the normal where it enters
};
[[nodiscard]] RealCrossing cross_ball(const RealVec& org, const RealVec& dir, Real radius);

/// Radius 1, y in [-1/2, 1/2]; by intervals.
struct RealCylinder {
    bool hit;
    Real t0, t1;
    Real cosine;
    bool cap;  ///< it enters through one
    Real gap;  ///< 1 - how near the ray comes to the axis
    Real band; ///< how near, in t, an end of the body is to an end of the caps
};
[[nodiscard]] RealCylinder cross_body(const RealVec& org, const RealVec& dir);

/// Where a ray meets the plane of a triangle.
struct RealTriangle {
    Real t;
    Real cosine; ///< |n . d|, both unit
};
[[nodiscard]] RealTriangle cross_plane_of(const RealVec& a, const RealVec& b, const RealVec& c, const RealVec& org,
                                          const RealVec& dir);

/// The ray in the space of an affine record, without rounding to speak of.
[[nodiscard]] RealVec to_object(const AffineRecord& record, const RealVec& p_world);
[[nodiscard]] RealVec to_object_direction(const AffineRecord& record, const RealVec& d_world);

} // namespace lanecast::selftest
