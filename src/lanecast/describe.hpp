#pragma once
// What the caller of the library has, as the description that `flatten` takes.

#include "lanecast/lanecast.hpp"
#include "scene/description.hpp"

namespace lanecast {

/// Checks every index and coordinate; throws Error (scene).
[[nodiscard]] SceneDescription describe(std::span<const MeshArrays> meshes);

/// Throws Error (scene, asset).
[[nodiscard]] SceneDescription describe(const std::filesystem::path& file);

} // namespace lanecast
