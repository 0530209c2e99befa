#pragma once
// A description as JSON, every key written out: loading it back must give the same description, and two descriptions are
// equal when their texts are.

#include "scene/description.hpp"

#include <nlohmann/json.hpp>

namespace lanecast {

using Json = nlohmann::json;

inline Json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

inline Json to_json(const Material& m) {
    return {{"ambient", to_json(m.ambient)},       {"diffuse", to_json(m.diffuse)},           {"specular", to_json(m.specular)},
            {"reflective", to_json(m.reflective)}, {"transmissive", to_json(m.transmissive)}, {"shininess", m.shininess},
            {"refraction", m.refraction}};
}

inline Json to_json(const Transformation& transformation) {
    if (const auto* rotation = std::get_if<Rotation>(&transformation))
        return {{"type", "rotation"}, {"axis", to_json(rotation->axis)}, {"degrees", rotation->degrees}};
    if (const auto* scale = std::get_if<Scale>(&transformation)) return {{"type", "scale"}, {"scale", to_json(scale->scale)}};
    return {{"type", "translate"}, {"translate", to_json(std::get<Translation>(transformation).translate)}};
}

inline Json to_json(const Object& object) {
    Json out = {{"material", to_json(object.material)}, {"name", object.name}};
    if (!std::holds_alternative<Plane>(object.shape)) {
        out["transformations"] = Json::array();
        for (const Transformation& transformation : object.transformations)
            out["transformations"].push_back(to_json(transformation));
    }
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
        out.update({{"type", "sphere"}, {"radius", sphere->radius}, {"position", to_json(sphere->position)}});
    } else if (const auto* cylinder = std::get_if<Cylinder>(&object.shape)) {
        out.update(
            {{"type", "cylinder"}, {"radius", cylinder->radius}, {"height", cylinder->height}, {"capped", cylinder->capped}});
    } else if (const auto* cone = std::get_if<Cone>(&object.shape)) {
        out.update({{"type", "cone"},
                    {"base_radius", cone->base_radius},
                    {"apex_radius", cone->apex_radius},
                    {"height", cone->height},
                    {"capped", cone->capped}});
    } else if (const auto* plane = std::get_if<Plane>(&object.shape)) {
        out.update({{"type", "plane"}, {"position", to_json(plane->position)}, {"normal", to_json(plane->normal)}});
    } else {
        const Mesh& mesh = std::get<Mesh>(object.shape);
        out["type"] = "mesh";
        out["triangles"] = Json::array();
        for (const auto& triangle : mesh.triangles) {
            Json corners = Json::array();
            for (const std::uint32_t index : triangle) corners.push_back(to_json(mesh.positions.at(index)));
            out["triangles"].push_back(std::move(corners));
        }
    }
    return out;
}

inline Json to_json(const Light& light) {
    if (const auto* ambient = std::get_if<AmbientLight>(&light)) return {{"type", "ambient"}, {"color", to_json(ambient->color)}};
    if (const auto* sun = std::get_if<DirectionalLight>(&light))
        return {{"type", "directional"},
                {"color", to_json(sun->color)},
                {"direction", to_json(sun->direction)},
                {"angle", sun->angle}};
    if (const auto* point = std::get_if<PointLight>(&light))
        return {{"type", "point"},
                {"color", to_json(point->color)},
                {"position", to_json(point->position)},
                {"attenuation", point->attenuation},
                {"radius", point->radius}};
    const SpotLight& spot = std::get<SpotLight>(light);
    return {{"type", "spot"},
            {"color", to_json(spot.color)},
            {"position", to_json(spot.position)},
            {"direction", to_json(spot.direction)},
            {"cutoff", spot.cutoff},
            {"attenuation", spot.attenuation},
            {"radius", spot.radius}};
}

inline Json to_json(const Camera& camera) {
    return {{"field", camera.field},
            {"background", to_json(camera.background)},
            {"position", to_json(camera.position)},
            {"look_at", to_json(camera.look_at)},
            {"up", to_json(camera.up)},
            {"near", camera.near},
            {"resolution", camera.resolution}};
}

inline Json to_json(const RenderSettings& render) {
    static const char* const modes[] = {"off", "cross", "grid", "edge"};
    static const char* const bvh_modes[] = {"off", "default", "quality"};
    static const char* const precisions[] = {"fast", "balanced", "precise", "reference"};
    const AntiAliasing& aa = render.anti_aliasing;
    return {{"ambient", render.ambient},
            {"diffuse", render.diffuse},
            {"specular", render.specular},
            {"shadows", render.shadows},
            {"transmissive_shadows", render.transmissive_shadows},
            {"reflections", render.reflections},
            {"transmission", render.transmission},
            {"refraction", render.refraction},
            {"schlick", render.schlick},
            {"planes", render.planes},
            {"bvh", bvh_modes[static_cast<int>(render.bvh)]},
            {"anti_aliasing",
             {{"mode", modes[static_cast<int>(aa.mode)]}, {"samples", aa.samples}, {"offset", aa.offset}, {"planes", aa.planes}}},
            {"soft_shadows", render.soft_shadows},
            {"depth", render.depth},
            {"cutoff", render.cutoff},
            {"precision", precisions[static_cast<int>(render.precision)]}};
}

inline Json to_json(const SceneDescription& scene) {
    Json out = {{"camera", to_json(scene.camera)},
                {"objects", Json::array()},
                {"lights", Json::array()},
                {"render", to_json(scene.render)}};
    for (const Object& object : scene.objects) out["objects"].push_back(to_json(object));
    for (const Light& light : scene.lights) out["lights"].push_back(to_json(light));
    return out;
}

} // namespace lanecast
