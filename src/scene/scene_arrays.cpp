#include "scene/scene_arrays.hpp"

#include <algorithm>

namespace lanecast {

SceneView view(const SceneArrays& arrays) noexcept {
    SceneView v{};
    v.arena = arrays.arena.get();
    v.leaves = arrays.leaves.data();
    v.triangles = arrays.triangles.data();
    v.spheres = arrays.spheres.data();
    v.affines = arrays.affines.data();
    v.affine_shading = arrays.affine_shading.data();
    v.planes = arrays.planes.data();
    v.scene_id = arrays.scene_id.data();
    v.object = arrays.object.data();
    v.material = arrays.material.data();
    v.shared_slots = arrays.shared_slots.data();
    v.materials = arrays.materials.data();
    v.lights = arrays.lights.data();
    std::copy(std::begin(arrays.first_slot), std::end(arrays.first_slot), v.first_slot);
    v.leaf_count = static_cast<std::uint32_t>(arrays.leaves.size());
    v.light_count = static_cast<std::uint32_t>(arrays.lights.size());
    v.features = arrays.features;
    std::copy(std::begin(arrays.ambient), std::end(arrays.ambient), v.ambient);
    std::copy(std::begin(arrays.background), std::end(arrays.background), v.background);
    v.max_coordinate = arrays.max_coordinate;
    return v;
}

std::size_t memory_bytes(const SceneArrays& arrays) noexcept {
    const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return arrays.arena_bytes + bytes(arrays.leaves) + bytes(arrays.triangles) + bytes(arrays.spheres) + bytes(arrays.affines) +
           bytes(arrays.affine_shading) + bytes(arrays.planes) + bytes(arrays.scene_id) + bytes(arrays.object) +
           bytes(arrays.material) + bytes(arrays.shared_slots) + bytes(arrays.materials) + bytes(arrays.lights);
}

} // namespace lanecast
