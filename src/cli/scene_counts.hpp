#pragma once
// How much of what a scene holds.

#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"

#include <array>
#include <cstddef>

namespace lanecast {

struct SceneCounts {
    std::array<std::size_t, 5> objects{}; ///< by Shape: spheres, cylinders, cones, planes, meshes
    std::array<std::size_t, 4> lights{};  ///< by Light: ambient, directional, point, spot
    std::size_t triangles = 0;            ///< of the file, degenerate ones included
};

[[nodiscard]] inline SceneCounts count_scene(const SceneDescription& scene) {
    SceneCounts counts;
    for (const Object& object : scene.objects) {
        ++counts.objects[object.shape.index()];
        if (const Mesh* const mesh = std::get_if<Mesh>(&object.shape)) counts.triangles += mesh->triangles.size();
    }
    for (const Light& light : scene.lights) ++counts.lights[light.index()];
    return counts;
}

/// By PrimitiveKind, as they are rendered.
[[nodiscard]] inline std::array<std::size_t, primitive_kind_count> count_primitives(const SceneArrays& arrays) {
    std::array<std::size_t, primitive_kind_count> counts{};
    for (std::size_t kind = 0; kind < counts.size(); ++kind) counts[kind] = arrays.first_slot[kind + 1] - arrays.first_slot[kind];
    return counts;
}

} // namespace lanecast
