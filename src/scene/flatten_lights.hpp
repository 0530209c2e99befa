#pragma once
// Lights in normalised lengths.

#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"

namespace lanecast {

/// Fills lights, ambient, background and the feature bits of lights. Attenuation is of normalised distance:
/// linear / scale, quadratic / scale^2, at most 2^100, so that a squared far distance times it stays finite.
void flatten_lights(const SceneDescription& scene, const RenderSettings& settings, SceneArrays& arrays);

} // namespace lanecast
