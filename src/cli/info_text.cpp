#include "cli/info_report.hpp"

#include "cli/names.hpp"
#include "cli/print.hpp"
#include "cli/scene_counts.hpp"
#include "render/dispatch.hpp"
#include "scene/bvh_quality.hpp"
#include "scene/text_tools.hpp"

#include <cmath>
#include <cstdio>

namespace lanecast {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value + 0.0); // no -0
    return text;
}

std::string point(const glm::dvec3& p) { return "(" + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ")"; }

void line(std::string& text, const char* label, const std::string& value) {
    char start[32];
    std::snprintf(start, sizeof start, "%-17s", label);
    text += start + value + "\n";
}

/// "3: 1 ambient, 2 point"
template <std::size_t n, class Name>
std::string breakdown(const std::array<std::size_t, n>& counts, const Name& name) {
    std::size_t sum = 0;
    std::string parts;
    for (std::size_t i = 0; i < n; ++i) {
        sum += counts[i];
        if (counts[i] > 0) parts += (parts.empty() ? "" : ", ") + name(i, counts[i]);
    }
    return std::to_string(sum) + (parts.empty() ? "" : ": " + parts);
}

std::string list_features(const std::vector<Feature>& features, bool used) {
    std::string names;
    for (const Feature& feature : features)
        if (feature.used == used) names += (names.empty() ? "" : ", ") + std::string(feature.name);
    return names.empty() ? "nothing" : names;
}

std::string instruction_sets(Precision precision) {
    std::string text;
    for (const IsaInfo& isa : known_isas()) {
        const char* state = !isa.compiled                     ? "not in this build"
                            : !isa.supported                  ? "not on this CPU"
                            : isa.name == best_isa(precision) ? "used"
                                                              : "";
        text += (text.empty() ? "" : ", ") + isa.name + (*state == 0 ? "" : std::string(" (") + state + ")");
    }
    return text;
}

std::string precisions(Precision used) {
    std::string text;
    for (const Precision precision : {Precision::fast, Precision::balanced, Precision::precise, Precision::reference}) {
        const char* state = best_isa(precision).empty() ? " (not in this build)" : precision == used ? " (used)" : "";
        text += (text.empty() ? "" : ", ") + std::string(name_of(precision)) + state;
    }
    return text;
}

void add_tree(std::string& text, const BvhQuality& tree) {
    if (tree.nodes == 0) return line(text, "tree", "none");
    line(text, "tree",
         counted(tree.nodes, "node") + " of 8, " + std::to_string(tree.leaves) + (tree.leaves == 1 ? " leaf, " : " leaves, ") +
             counted(static_cast<std::size_t>(tree.depth), "level") + ", SAH cost " + number(tree.sah_cost));
    std::string sizes;
    for (int n = 1; n <= max_leaf_size; ++n)
        if (tree.leaf_sizes[n] > 0)
            sizes += (sizes.empty() ? "" : ", ") + std::to_string(tree.leaf_sizes[n]) + " of " + std::to_string(n);
    line(text, "leaves", sizes);
    line(text, "overlap", fixed(100 * tree.overlapping_share, 1) + " % of nodes have children that share more than half a box");
}

} // namespace

std::string info_text(const RequestedScene& scene, const SceneArrays& arrays) {
    const SceneDescription& description = scene.description;
    const SceneCounts counts = count_scene(description);
    const auto primitives = count_primitives(arrays);
    const std::size_t slots = arrays.first_slot[primitive_kind_count];
    std::string text;
    line(text, "scene", printable(description.file, 4096));
    line(text, "objects", breakdown(counts.objects, [](std::size_t i, std::size_t n) { return counted(n, shape_names[i]); }));
    line(text, "primitives", breakdown(primitives, [](std::size_t i, std::size_t n) { return counted(n, primitive_names[i]); }));
    if (arrays.degenerate_triangles > 0)
        line(text, "triangles",
             std::to_string(counts.triangles) +
                 " in the file; degenerate and dropped: " + std::to_string(arrays.degenerate_triangles));
    line(text, "lights",
         breakdown(counts.lights, [](std::size_t i, std::size_t n) { return std::to_string(n) + " " + light_names[i]; }));
    line(text, "image",
         std::to_string(description.camera.resolution[0]) + "x" + std::to_string(description.camera.resolution[1]));
    line(text, "bounds",
         has_bounds(arrays) ? point(arrays.bounds_min) + " to " + point(arrays.bounds_max) : "nothing is bounded");
    const auto bytes = static_cast<double>(memory_bytes(arrays));
    line(text, "memory",
         short_bytes(bytes) + (slots > 0 ? ", " + fixed(bytes / static_cast<double>(slots), 1) + " bytes per primitive" : ""));
    add_tree(text, measure_quality(arrays.arena.get()));
    const std::vector<Feature> features = features_of(arrays, scene.settings);
    line(text, "models", list_features(features, true));
    line(text, "leaves out", list_features(features, false));
    const Normalisation& n = arrays.normalisation;
    line(text, "normalisation",
         "centre " + point(n.centre) + ", scale 2^" + std::to_string(std::ilogb(n.scale)) +
             (n.exact ? ", exact" : ", centring rounded coordinates"));
    line(text, "float grid", number(grid_spacing(arrays)) + " scene units at the farthest point");
    line(text, "instruction sets", instruction_sets(scene.settings.precision));
    line(text, "precisions", precisions(scene.settings.precision));
    line(text, "warnings", std::to_string(scene.warnings.size()));
    return text;
}

} // namespace lanecast
