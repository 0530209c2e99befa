#include "cli/pixel_tree.hpp"

#include "scene/flatten_objects.hpp"

#include <cmath>

namespace lanecast {
namespace {

std::array<float, 3> triple(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

Triple world(const Normalisation& n, const float (&p)[3]) {
    Triple out{};
    for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = static_cast<double>(p[i]) / n.scale + n.centre[i];
    return out;
}

double length(const float (&v)[3]) {
    return std::hypot(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
}

Triple unit(const float (&v)[3]) {
    const double l = length(v);
    return {static_cast<double>(v[0]) / l, static_cast<double>(v[1]) / l, static_cast<double>(v[2]) / l};
}

void set_surface(RayNode& node, const TraceRecord& record, const SceneView& view, const FlatObjects& objects,
                 const Normalisation& n) {
    const auto slot = static_cast<std::uint32_t>(record.slot);
    const FlatObject& object = objects.objects[view.object[slot]];
    node.object = static_cast<int>(object.index);
    if (object.kind == PrimitiveKind::triangle) node.triangle = static_cast<long>(view.scene_id[slot] - object.first_scene_id);
    node.distance = static_cast<double>(record.t) * length(record.dir) / n.scale;
    node.point = world(n, record.point);
    for (std::size_t i = 0; i < 3; ++i) node.normal[i] = static_cast<double>(record.normal[i]);
    node.inside = record.inside != 0;
    node.ambient = triple(record.ambient);
    node.fresnel = record.fresnel;
    const MaterialRecord& material = view.materials[view.material[slot]];
    node.reflective = triple(material.reflective);
    node.transmissive = triple(material.transmissive);
}

} // namespace

PixelTree pixel_tree(const PixelTrace& trace, const SceneArrays& arrays, const SceneDescription& scene) {
    const SceneView scene_view = view(arrays);
    const FlatObjects objects = prepare_objects(scene);
    PixelTree tree;
    tree.color = trace.color;
    for (const TraceRecord& record : trace.rays) {
        RayNode node;
        node.kind = record.kind;
        node.level = record.level;
        node.org = world(arrays.normalisation, record.org);
        node.dir = unit(record.dir);
        node.color = triple(record.color);
        if (record.slot >= 0) set_surface(node, record, scene_view, objects, arrays.normalisation);
        if (record.parent >= 0) tree.rays[static_cast<std::size_t>(record.parent)].children.push_back(tree.rays.size());
        tree.rays.push_back(std::move(node));
    }
    std::vector<int> file_index; // of the kernels' lights, which leave out the ambient one
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (!std::holds_alternative<AmbientLight>(scene.lights[i])) file_index.push_back(static_cast<int>(i));
    for (const TraceLight& light : trace.lights)
        tree.rays[static_cast<std::size_t>(light.ray)].lights.push_back(
            {file_index[static_cast<std::size_t>(light.light)], triple(light.visibility), triple(light.color)});
    return tree;
}

} // namespace lanecast
