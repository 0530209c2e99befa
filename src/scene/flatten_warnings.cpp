#include "scene/flatten_warnings.hpp"

#include "scene/flatten_meshes.hpp"
#include "scene/normalise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lanecast {
namespace {

double longest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double extent_of(const DoubleBox& box) { return longest(box.hi - box.lo); }

/// From a point to the farthest side of the box.
double reach(const DoubleBox& box, const glm::dvec3& from) { return std::max(longest(box.lo - from), longest(box.hi - from)); }

/// Of the floats at the coordinate farthest from the centre, in world units.
double grid_step(const DoubleBox& all, const Normalisation& n) {
    const double farthest = std::max(longest(normalised(n, all.lo)), longest(normalised(n, all.hi)));
    return std::ldexp(1.0, std::ilogb(farthest) - 23) / n.scale;
}

} // namespace

std::optional<std::string> fine_object_warning(const FlatObjects& objects, const std::vector<DoubleBox>& boxes,
                                               const Normalisation& normalisation) {
    DoubleBox all;
    for (const DoubleBox& box : boxes) include(all, box);
    const FlatObject *smallest = nullptr, *farthest = nullptr;
    for (const FlatObject& flat : objects.objects) {
        const DoubleBox& box = boxes[flat.index];
        if (is_empty(box) || !(extent_of(box) > 0)) continue; // without extent: its triangles are dropped, and that is told
        if (!smallest || extent_of(box) < extent_of(boxes[smallest->index])) smallest = &flat;
    }
    if (!smallest) return {};
    const DoubleBox& small = boxes[smallest->index];
    const double steps = extent_of(small) / grid_step(all, normalisation);
    if (steps >= fewest_steps) return {};

    const glm::dvec3 centre = 0.5 * small.lo + 0.5 * small.hi;
    for (const FlatObject& flat : objects.objects)
        if (!is_empty(boxes[flat.index]) &&
            (!farthest || reach(boxes[flat.index], centre) > reach(boxes[farthest->index], centre)))
            farthest = &flat;
    char text[160];
    std::snprintf(text, sizeof text, ": is %.3g steps of single precision across: %.3g units in a scene of %.3g, as far as ",
                  steps, extent_of(small), extent_of(all));
    return label(*smallest) + text + label(*farthest) + " reaches; expect rough edges and shadows";
}

std::string dropped_triangles_warning(const FlatObjects& objects, const std::vector<std::uint32_t>& dropped) {
    const auto in = [&](const FlatObject& flat) {
        const auto* mesh = std::get_if<Mesh>(&flat.object->shape);
        if (mesh == nullptr) return std::ptrdiff_t{0};
        const auto end = static_cast<std::uint32_t>(flat.first_ref + mesh->triangles.size());
        return std::lower_bound(dropped.begin(), dropped.end(), end) -
               std::lower_bound(dropped.begin(), dropped.end(), flat.first_ref);
    };
    std::string first;
    std::ptrdiff_t in_first = 0, meshes = 0;
    for (const FlatObject& flat : objects.objects) {
        const std::ptrdiff_t count = in(flat);
        if (count > 0 && meshes++ == 0) first = label(flat), in_first = count;
    }
    const auto triangles = [](std::ptrdiff_t n) {
        return std::to_string(n) + (n == 1 ? " degenerate triangle was dropped" : " degenerate triangles were dropped");
    };
    if (meshes == 1) return first + ": " + triangles(in_first);
    return first + ": " + triangles(in_first) + " (" + std::to_string(dropped.size()) + " in all, in " + std::to_string(meshes) +
           " meshes)";
}

} // namespace lanecast
