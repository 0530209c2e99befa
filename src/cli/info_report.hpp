#pragma once
// What `info` tells of a scene, as text and as JSON.

#include "cli/frame_request.hpp"

#include <string>
#include <vector>

namespace lanecast {

/// A thing the renderer can model, and whether this scene with these settings makes it.
struct Feature {
    const char* name;
    bool used;
};
[[nodiscard]] std::vector<Feature> features_of(const SceneArrays& arrays, const RenderSettings& settings);

/// Spacing of floats at the largest coordinate, in scene units.
[[nodiscard]] double grid_spacing(const SceneArrays& arrays);

/// Whether anything is bounded.
[[nodiscard]] inline bool has_bounds(const SceneArrays& arrays) { return arrays.bounds_min.x <= arrays.bounds_max.x; }

[[nodiscard]] std::string info_text(const RequestedScene& scene, const SceneArrays& arrays);
[[nodiscard]] std::string info_json(const RequestedScene& scene, const SceneArrays& arrays);

} // namespace lanecast
