#pragma once
// What is decided of a triangle from its float vertices: whether it is one, and its normal. No thresholds.

namespace lanecast {

/// (b - a) x (c - a) in double, correctly signed and exactly zero only where the three points are exactly collinear or equal.
/// Relative error of each component below 2^-20 of the largest, for any needle.
void triangle_cross(const float a[3], const float b[3], const float c[3], double cross[3]);

/// Two vertices are equal or the three are exactly collinear.
[[nodiscard]] bool is_degenerate(const float a[3], const float b[3], const float c[3]);

/// Unit, by the winding. The triangle must not be degenerate.
void triangle_normal(const float a[3], const float b[3], const float c[3], float normal[3]);

} // namespace lanecast
