#include "scene/load_parts.hpp"

namespace lanecast {
namespace {

Light load_light(SceneReader& reader, NodeId node) {
    const BlockSpec& spec = spec_by_type(reader, node, format::lights);
    const Block block(reader, node, spec);
    if (spec.name == "ambient") {
        AmbientLight out;
        block.read("color", out.color);
        return out;
    }
    if (spec.name == "directional") {
        DirectionalLight out;
        block.read("color", out.color);
        block.read("direction", out.direction);
        block.read("angle", out.angle);
        return out;
    }
    if (spec.name == "point") {
        PointLight out;
        block.read("color", out.color);
        block.read("position", out.position);
        block.read("attenuation", out.attenuation);
        block.read("radius", out.radius);
        return out;
    }
    SpotLight out;
    block.read("color", out.color);
    block.read("position", out.position);
    block.read("direction", out.direction);
    block.read("cutoff", out.cutoff);
    block.read("attenuation", out.attenuation);
    block.read("radius", out.radius);
    return out;
}

} // namespace

std::vector<Light> load_lights(SceneReader& reader, NodeId list) {
    std::vector<Light> out;
    bool ambient = false;
    for (const NodeId node : items(reader, list)) {
        out.push_back(load_light(reader, node));
        if (!std::holds_alternative<AmbientLight>(out.back())) continue;
        if (ambient) fail(reader, node, "a second ambient light; a scene has at most one");
        ambient = true;
    }
    return out;
}

} // namespace lanecast
