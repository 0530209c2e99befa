// The camera and the render block.

#include "scene/load_parts.hpp"

#include <algorithm>
#include <string>

#include <glm/geometric.hpp>

namespace lanecast {
namespace {

/// sin of the smallest angle between view and up: far above the rounding of the cross product, far below any real camera.
constexpr double smallest_up_sine = 1e-7;

RenderSettings read_switches(const Block& block) {
    RenderSettings out;
    block.read("ambient", out.ambient);
    block.read("diffuse", out.diffuse);
    block.read("specular", out.specular);
    block.read("shadows", out.shadows);
    block.read("transmissive_shadows", out.transmissive_shadows);
    block.read("reflections", out.reflections);
    block.read("transmission", out.transmission);
    block.read("refraction", out.refraction);
    block.read("schlick", out.schlick);
    block.read("planes", out.planes);
    block.read_choice("bvh", out.bvh);
    block.read("soft_shadows", out.soft_shadows);
    block.read("depth", out.depth);
    block.read("cutoff", out.cutoff);
    block.read_choice("precision", out.precision);
    return out;
}

} // namespace

RenderSettings load_render_settings(SceneReader& reader, NodeId node) {
    const Block block(reader, node, format::render);
    RenderSettings out = read_switches(block);
    if (const NodeId at = block.find("anti_aliasing"); at != no_node) {
        const Block anti_aliasing(reader, at, format::anti_aliasing);
        anti_aliasing.read_choice("mode", out.anti_aliasing.mode);
        anti_aliasing.read("samples", out.anti_aliasing.samples);
        anti_aliasing.read("offset", out.anti_aliasing.offset);
        anti_aliasing.read("planes", out.anti_aliasing.planes);
    }
    return out;
}

Camera load_camera(SceneReader& reader, NodeId node) {
    const Block block(reader, node, format::camera);
    Camera out;
    block.read("field", out.field);
    block.read("background", out.background);
    block.read("position", out.position);
    block.read("up", out.up);
    block.read("near", out.near);
    block.read("resolution", out.resolution);
    // Without look_at a camera that was moved still looks down -z, wherever it is.
    out.look_at = out.position - glm::dvec3(0, 0, std::max(1.0, glm::length(out.position)));
    block.read("look_at", out.look_at);

    const glm::dvec3 view = out.look_at - out.position;
    const NodeId view_place = block.place_of(block.has("look_at") ? "look_at" : "position");
    if (glm::length(view) < smallest_length) fail(reader, view_place, "must differ from the camera's position");
    const glm::dvec3 right = glm::cross(glm::normalize(view), glm::normalize(out.up));
    if (glm::length(right) < smallest_up_sine)
        fail(reader, block.has("up") ? block.find("up") : view_place,
             block.has("up") ? "must not be parallel to the view direction"
                             : "the view direction is parallel to the camera's up direction [0, 1, 0]; give it another `up`");
    const double pixels = static_cast<double>(out.resolution[0]) * out.resolution[1];
    if (pixels > largest_pixel_count)
        fail(reader, block.find("resolution"),
             "must not have more than 268435456 pixels, got " + std::to_string(out.resolution[0]) + " x " +
                 std::to_string(out.resolution[1]));
    return out;
}

} // namespace lanecast
