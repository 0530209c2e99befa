#include "scene/flatten_materials.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

namespace lanecast {
namespace {

using MaterialBits = std::array<std::uint32_t, sizeof(MaterialRecord) / 4>;

void store(float (&to)[3], const glm::dvec3& from, bool enabled = true) {
    for (int i = 0; i < 3; ++i)
        to[i] = enabled ? static_cast<float>(from[i]) + 0.0f : 0.0f; // no -0, which would look like another material
}

bool any(const float (&color)[3]) { return color[0] != 0 || color[1] != 0 || color[2] != 0; }

class Table {
public:
    explicit Table(const RenderSettings& settings) : settings_(settings) {}

    std::uint32_t index_of(const Material& material) {
        const MaterialRecord record = material_record(material, settings_);
        const auto [place, is_new] =
            known_.try_emplace(std::bit_cast<MaterialBits>(record), static_cast<std::uint32_t>(records.size()));
        if (is_new) records.push_back(record);
        return place->second;
    }

    std::vector<MaterialRecord> records;

private:
    const RenderSettings& settings_;
    std::map<MaterialBits, std::uint32_t> known_;
};

} // namespace

MaterialRecord material_record(const Material& material, const RenderSettings& settings) {
    MaterialRecord record{};
    store(record.ambient, material.ambient, settings.ambient);
    store(record.diffuse, material.diffuse, settings.diffuse);
    store(record.specular, material.specular, settings.specular);
    store(record.reflective, material.reflective, settings.reflections);
    store(record.transmissive, material.transmissive, settings.transmission);
    record.shininess = static_cast<float>(material.shininess) + 0.0f;
    record.refraction = settings.refraction ? static_cast<float>(material.refraction) + 0.0f : 0.0f;
    return record;
}

FlatMaterials flatten_materials(const FlatObjects& objects, const RenderSettings& settings) {
    FlatMaterials result;
    Table table(settings);
    for (const FlatObject& flat : objects.objects) {
        result.first.push_back(static_cast<std::uint32_t>(result.record_of.size()));
        const auto* mesh = std::get_if<Mesh>(&flat.object->shape);
        if (mesh && !mesh->triangle_material.empty()) {
            std::vector<unsigned char> is_used(mesh->materials.size());
            for (const std::uint32_t m : mesh->triangle_material) is_used[m] = 1;
            for (std::size_t m = 0; m < mesh->materials.size(); ++m)
                result.record_of.push_back(is_used[m] ? table.index_of(mesh->materials[m]) : 0);
        } else {
            const bool is_absent = (flat.kind == PrimitiveKind::plane && !settings.planes) || (mesh && mesh->triangles.empty());
            result.record_of.push_back(is_absent ? 0 : table.index_of(flat.object->material));
        }
    }
    result.records = std::move(table.records);
    return result;
}

std::uint32_t material_features(const std::vector<MaterialRecord>& records) {
    std::uint32_t features = 0;
    for (const MaterialRecord& material : records) {
        if (any(material.specular)) features |= feature_specular;
        if (any(material.reflective)) features |= feature_reflective;
        if (any(material.transmissive)) features |= feature_transmissive | (material.refraction != 0 ? feature_refraction : 0);
    }
    return features;
}

} // namespace lanecast
