#pragma once
// Boxes. Those of quadrics come from support functions in double and are rounded outwards.

#include "scene/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace lanecast {

struct Box {
    float lo[3];
    float hi[3];
};

/// Empty until something is included.
struct DoubleBox {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
};

inline void include(DoubleBox& box, const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], p[axis]);
        box.hi[axis] = std::max(box.hi[axis], p[axis]);
    }
}

inline void include(DoubleBox& box, const DoubleBox& other) {
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], other.lo[axis]);
        box.hi[axis] = std::max(box.hi[axis], other.hi[axis]);
    }
}

[[nodiscard]] inline bool is_empty(const DoubleBox& box) { return !(box.lo.x <= box.hi.x); }

[[nodiscard]] inline float rounded_down(double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
[[nodiscard]] inline float rounded_up(double x) {
    const float f = static_cast<float>(x);
    return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// Half extents of `linear` applied to the unit sphere: the support function along each axis.
[[nodiscard]] inline glm::dvec3 ellipsoid_extent(const glm::dmat3& linear) {
    glm::dvec3 extent;
    for (int row = 0; row < 3; ++row) extent[row] = std::hypot(linear[0][row], linear[1][row], linear[2][row]);
    return extent;
}

/// Box of `linear` applied to the unit cone, radius 1 + taper * y, y in [-1/2, 1/2]; taper 0: the unit cylinder.
[[nodiscard]] inline DoubleBox cone_box(const glm::dmat3& linear, double taper) {
    DoubleBox box;
    for (const double y : {-0.5, 0.5})
        for (int row = 0; row < 3; ++row) {
            const double radius = (1 + taper * y) * std::hypot(linear[0][row], linear[2][row]);
            box.lo[row] = std::min(box.lo[row], y * linear[1][row] - radius);
            box.hi[row] = std::max(box.hi[row], y * linear[1][row] + radius);
        }
    return box;
}

/// Box of a quadric with the body's exact box about `centre`. Its computed t carries a few ulp of error, so the result is 2^-20
/// of its extent and of its coordinates larger. `condition`, of its matrix, magnifies what rounding the ray's coordinates, of 1
/// or so, does.
[[nodiscard]] inline Box quadric_box(const glm::dvec3& centre, const DoubleBox& body, double condition = 0) {
    double size = 0;
    for (int axis = 0; axis < 3; ++axis) size = std::max(size, std::abs(centre[axis]) + std::max(-body.lo[axis], body.hi[axis]));
    const double margin = 0x1p-20 * size + 0x1p-19 * condition; // |coordinate| + extent of the worst axis
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = rounded_down(centre[axis] + body.lo[axis] - margin);
        box.hi[axis] = rounded_up(centre[axis] + body.hi[axis] + margin);
    }
    return box;
}

} // namespace lanecast
