#pragma once
// Materials after the switches, each stored once.

#include "scene/description.hpp"
#include "scene/flatten_objects.hpp"
#include "scene/scene_view.hpp"

#include <cstdint>
#include <vector>

namespace lanecast {

/// Without what the settings switch off.
[[nodiscard]] MaterialRecord material_record(const Material& material, const RenderSettings& settings);

struct FlatMaterials {
    std::vector<MaterialRecord> records;  ///< no two alike
    std::vector<std::uint32_t> first;     ///< per object: where its entries in `record_of` begin
    std::vector<std::uint32_t> record_of; ///< record of the object's material, or of each of its mesh's materials
};

/// In the order of the file; materials that only dropped planes or no triangle at all would use are left out.
[[nodiscard]] FlatMaterials flatten_materials(const FlatObjects& objects, const RenderSettings& settings);

/// Record of one primitive; `triangle` counts within the mesh.
[[nodiscard]] inline std::uint32_t material_of(const FlatMaterials& materials, const FlatObject& object, std::uint32_t triangle) {
    const std::uint32_t first = materials.first[object.index];
    const auto* mesh = std::get_if<Mesh>(&object.object->shape);
    return materials.record_of[mesh && !mesh->triangle_material.empty() ? first + mesh->triangle_material[triangle] : first];
}

/// feature_* bits that materials decide.
[[nodiscard]] std::uint32_t material_features(const std::vector<MaterialRecord>& records);

} // namespace lanecast
