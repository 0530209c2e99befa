#pragma once
// The only place that knows both the description and the arrays.

#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"

namespace lanecast {

/// Bakes transforms in double, normalises, builds the tree with `threads` workers (>= 1; the result does not depend on it) and
/// applies the settings that remove things: planes, reflections, transmission, refraction, specular, ambient, diffuse off. Throws
/// Error (scene) where the scene's range cannot be represented, Error (memory) where the arena exceeds 2 GiB.
[[nodiscard]] SceneArrays flatten(const SceneDescription& scene, const RenderSettings& settings, int threads);

} // namespace lanecast
