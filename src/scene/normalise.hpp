#pragma once
// The exact change of units that puts bounded geometry at coordinates of about 1.

#include "scene/bounds.hpp"
#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"

#include <glm/vec3.hpp>

namespace lanecast {

/// `bounds`: of the bounded geometry in world units, may be empty. Camera, lights and planes at up to 2^40 times its half extent
/// keep it at 1/2 < |largest coordinate| <= 1; up to 2^60 times they shrink it; beyond that Error (scene) names the one that is
/// too far. `exact` is left true.
[[nodiscard]] Normalisation find_normalisation(const DoubleBox& bounds, const SceneDescription& scene, bool with_planes);

/// Rounds in double where the centring is not exact.
[[nodiscard]] inline glm::dvec3 normalised(const Normalisation& n, const glm::dvec3& p_world) {
    return (p_world - n.centre) * n.scale;
}

/// Whether p_world - centre needed no rounding.
[[nodiscard]] inline bool is_exact(const Normalisation& n, const glm::dvec3& p_world) {
    for (int axis = 0; axis < 3; ++axis) { // Knuth's two-sum of p and -centre: its error term
        const double p = p_world[axis], c = n.centre[axis], d = p - c;
        const double c_part = p - d;
        if ((p - (d + c_part)) + (c_part - c) != 0) return false;
    }
    return true;
}

} // namespace lanecast
