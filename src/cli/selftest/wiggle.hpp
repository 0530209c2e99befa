#pragma once
// Whether two answers to a ray are both right, for its own numbers are rounded.

#include "cli/selftest/rays.hpp"

namespace lanecast::selftest {

/// What the double-precision kernels find when each coordinate of the ray is moved by up to so many of its roundings: the object
/// `object` (-1: nothing) at a t within what they find, give or take 4 ulp.
[[nodiscard]] bool is_answer(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& d, double roundings, int object,
                             float t);

} // namespace lanecast::selftest
