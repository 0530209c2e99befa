#include "cli/info_report.hpp"

#include "cli/json_writer.hpp"
#include "cli/scene_counts.hpp"
#include "render/dispatch.hpp"
#include "scene/bvh_quality.hpp"

#include <cmath>
#include <span>

namespace lanecast {
namespace {

void add_point(JsonWriter& json, const char* key, const glm::dvec3& p) {
    const double values[] = {p.x + 0.0, p.y + 0.0, p.z + 0.0}; // no -0
    json.add_numbers(key, std::span<const double>(values));
}

template <std::size_t n>
void add_counts(JsonWriter& json, const char* key, const std::array<std::size_t, n>& counts, const char* const (&names)[n]) {
    json.open_object(key);
    for (std::size_t i = 0; i < n; ++i) json.add(names[i], counts[i]);
    json.close_object();
}

void add_tree(JsonWriter& json, const BvhQuality& tree) {
    json.open_object("tree");
    json.add("nodes", tree.nodes);
    json.add("leaves", tree.leaves);
    json.add("levels", tree.depth);
    json.add("sah_cost", tree.sah_cost);
    json.add_numbers("leaf_sizes", std::span<const std::uint32_t>(tree.leaf_sizes).subspan(1)); // leaves of 1, 2, ..
    json.add("overlapping_share", tree.overlapping_share);
    json.close_object();
}

void add_normalisation(JsonWriter& json, const SceneArrays& arrays) {
    json.open_object("normalisation");
    add_point(json, "centre", arrays.normalisation.centre);
    json.add("scale", arrays.normalisation.scale);
    json.add("exact", arrays.normalisation.exact);
    json.add("grid", grid_spacing(arrays));
    json.close_object();
}

void add_instruction_sets(JsonWriter& json, Precision precision) {
    json.open_list("instruction_sets");
    for (const IsaInfo& isa : known_isas()) {
        json.open_object();
        json.add("name", isa.name);
        json.add("compiled", isa.compiled);
        json.add("supported", isa.supported);
        json.add("used", isa.name == best_isa(precision));
        json.close_object();
    }
    json.close_list();
    json.open_list("precisions");
    for (const Precision one : {Precision::fast, Precision::balanced, Precision::precise, Precision::reference}) {
        json.open_object();
        json.add("name", std::string(name_of(one)));
        json.add("compiled", !best_isa(one).empty());
        json.add("used", one == precision);
        json.close_object();
    }
    json.close_list();
}

} // namespace

std::string info_json(const RequestedScene& scene, const SceneArrays& arrays) {
    const SceneCounts counts = count_scene(scene.description);
    static constexpr const char* objects[] = {"spheres", "cylinders", "cones", "planes", "meshes"};
    static constexpr const char* lights[] = {"ambient", "directional", "point", "spot"};
    static constexpr const char* primitives[] = {"triangles", "spheres",    "ellipsoids", "cylinders",
                                                 "cones",     "open cones", "planes"};
    JsonWriter json;
    json.open_object();
    json.add("scene", scene.description.file);
    add_counts(json, "objects", counts.objects, objects);
    add_counts(json, "primitives", count_primitives(arrays), primitives);
    json.add("triangles", counts.triangles);
    json.add("degenerate_triangles", arrays.degenerate_triangles);
    add_counts(json, "lights", counts.lights, lights);
    json.add_numbers("image", std::span<const int>(scene.description.camera.resolution));
    if (has_bounds(arrays)) {
        add_point(json, "bounds_min", arrays.bounds_min);
        add_point(json, "bounds_max", arrays.bounds_max);
    } else {
        json.add_null("bounds_min");
        json.add_null("bounds_max");
    }
    json.add("memory_bytes", memory_bytes(arrays));
    add_tree(json, measure_quality(arrays.arena.get()));
    json.open_object("features");
    for (const Feature& feature : features_of(arrays, scene.settings)) json.add(feature.name, feature.used);
    json.close_object();
    add_normalisation(json, arrays);
    add_instruction_sets(json, scene.settings.precision);
    json.open_list("warnings");
    for (const std::string& warning : scene.warnings) json.add("", warning);
    json.close_list();
    json.close_object();
    return json.finished();
}

} // namespace lanecast
