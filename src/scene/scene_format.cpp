#include "scene/scene_format.hpp"

#include "scene/text_tools.hpp"

#include <array>

namespace lanecast {
namespace {

using enum ValueKind;

constexpr Range positive{.low = 0, .low_open = true};
constexpr Range not_negative{.low = 0};
constexpr bool required = true;

constexpr KeySpec type_key(const std::array<std::string_view, 1>& name) {
    return {.name = "type", .kind = choice, .required = true, .choices = name};
}
constexpr KeySpec color_key(std::string_view name, bool is_required = false) {
    return {
        .name = name, .kind = numbers, .required = is_required, .range = not_negative, .length = 3, .what = "a colour [r, g, b]"};
}
/// Its products with a colour, and the sums of these, are finite (`combine` in render/kernels/whitted.hpp).
constexpr KeySpec share_key(std::string_view name) {
    return {.name = name, .kind = numbers, .range = {.low = 0, .high = 1e6}, .length = 3, .what = "a colour [r, g, b]"};
}
constexpr KeySpec point_key(std::string_view name, bool is_required = false) {
    return {.name = name, .kind = numbers, .required = is_required, .length = 3, .what = "a point [x, y, z]"};
}
constexpr KeySpec direction_key(std::string_view name, bool is_required = false) {
    return {.name = name,
            .kind = numbers,
            .required = is_required,
            .length = 3,
            .rule = Rule::not_all_zero,
            .what = "a direction [x, y, z]"};
}
constexpr KeySpec length_key(std::string_view name) { return {.name = name, .required = true, .range = positive}; }
constexpr KeySpec switch_key(std::string_view name) { return {.name = name, .kind = boolean}; }

constexpr KeySpec attenuation_key{.name = "attenuation",
                                  .kind = numbers,
                                  .range = not_negative,
                                  .length = 3,
                                  .rule = Rule::not_all_zero,
                                  .what = "an attenuation [constant, linear, quadratic]"};
constexpr KeySpec source_radius_key{.name = "radius", .range = not_negative};
constexpr KeySpec name_key{.name = "name", .kind = text};
constexpr KeySpec transformations_key{.name = "transformations", .kind = list};
constexpr KeySpec material_key{.name = "material", .kind = block, .required = true};

constexpr KeySpec scene_keys[] = {{.name = "camera", .kind = block, .required = true},
                                  {.name = "objects", .kind = list, .required = true},
                                  {.name = "lights", .kind = list, .required = true},
                                  {.name = "render", .kind = block}};

constexpr KeySpec camera_keys[] = {{.name = "field", .range = {.low = 0, .high = 180, .low_open = true, .high_open = true}},
                                   color_key("background"),
                                   point_key("position"),
                                   point_key("look_at"),
                                   direction_key("up"),
                                   {.name = "near", .range = not_negative},
                                   {.name = "resolution",
                                    .kind = wholes,
                                    .range = {.low = 1, .high = largest_resolution},
                                    .length = 2,
                                    .what = "a resolution [width, height]"}};

// The order of the words is that of the enumerations.
constexpr std::array<std::string_view, 4> anti_alias_modes{"off", "cross", "grid", "edge"};
constexpr std::array<std::string_view, 3> bvh_modes{"off", "default", "quality"};
constexpr std::array<std::string_view, 4> precisions{"fast", "balanced", "precise", "reference"};

constexpr KeySpec anti_aliasing_keys[] = {{.name = "mode", .kind = choice, .required = true, .choices = anti_alias_modes},
                                          {.name = "samples", .kind = whole, .range = {.low = 1, .high = 64}},
                                          {.name = "offset", .range = {.low = 0, .high = 16, .low_open = true}},
                                          switch_key("planes")};

constexpr KeySpec render_keys[] = {switch_key("ambient"),
                                   switch_key("diffuse"),
                                   switch_key("specular"),
                                   switch_key("shadows"),
                                   switch_key("transmissive_shadows"),
                                   switch_key("reflections"),
                                   switch_key("transmission"),
                                   switch_key("refraction"),
                                   switch_key("schlick"),
                                   switch_key("planes"),
                                   {.name = "bvh", .kind = switch_or_choice, .choices = bvh_modes},
                                   {.name = "anti_aliasing", .kind = block},
                                   {.name = "soft_shadows", .kind = whole, .range = {.low = 0, .high = 1024}},
                                   {.name = "depth", .kind = whole, .range = {.low = 0, .high = 1024}},
                                   {.name = "cutoff", .range = {.low = 0, .high = 1}},
                                   {.name = "precision", .kind = choice, .choices = precisions}};

constexpr KeySpec material_keys[] = {color_key("ambient"),
                                     color_key("diffuse"),
                                     color_key("specular"),
                                     share_key("reflective"),
                                     share_key("transmissive"),
                                     {.name = "shininess", .range = not_negative},
                                     {.name = "refraction", .range = not_negative}};

constexpr std::array<std::string_view, 1> sphere_type{"sphere"}, cylinder_type{"cylinder"}, cone_type{"cone"},
    plane_type{"plane"}, mesh_type{"mesh"};
constexpr KeySpec sphere_keys[] = {type_key(sphere_type), length_key("radius"), point_key("position"),
                                   transformations_key,   material_key,         name_key};
constexpr KeySpec cylinder_keys[] = {type_key(cylinder_type),
                                     length_key("radius"),
                                     length_key("height"),
                                     switch_key("capped"),
                                     transformations_key,
                                     material_key,
                                     name_key};
constexpr KeySpec cone_keys[] = {type_key(cone_type),
                                 length_key("base_radius"),
                                 {.name = "apex_radius", .range = not_negative},
                                 length_key("height"),
                                 switch_key("capped"),
                                 transformations_key,
                                 material_key,
                                 name_key};
constexpr KeySpec plane_keys[] = {type_key(plane_type), point_key("position", required), direction_key("normal", required),
                                  material_key, name_key};
constexpr KeySpec mesh_keys[] = {type_key(mesh_type),
                                 {.name = "triangles", .kind = list},
                                 {.name = "file", .kind = text},
                                 transformations_key,
                                 {.name = "material", .kind = block}, // required unless a file may bring its own
                                 name_key};
constexpr BlockSpec shape_blocks[] = {{"sphere", "a sphere", sphere_keys},
                                      {"cylinder", "a cylinder", cylinder_keys},
                                      {"cone", "a cone", cone_keys},
                                      {"plane", "a plane", plane_keys},
                                      {"mesh", "a mesh", mesh_keys}};

constexpr std::array<std::string_view, 1> rotation_type{"rotation"}, scale_type{"scale"}, translate_type{"translate"};
constexpr KeySpec rotation_keys[] = {
    type_key(rotation_type), direction_key("axis", required), {.name = "degrees", .required = true}};
constexpr KeySpec scale_keys[] = {type_key(scale_type),
                                  {.name = "scale",
                                   .kind = numbers,
                                   .required = true,
                                   .length = 3,
                                   .rule = Rule::none_is_zero,
                                   .what = "a list of factors [x, y, z]"}};
constexpr KeySpec translate_keys[] = {type_key(translate_type), point_key("translate", required)};
constexpr BlockSpec transformation_blocks[] = {
    {"rotation", "a rotation", rotation_keys}, {"scale", "a scale", scale_keys}, {"translate", "a translation", translate_keys}};

constexpr std::array<std::string_view, 1> ambient_type{"ambient"}, directional_type{"directional"}, point_type{"point"},
    spot_type{"spot"};
constexpr KeySpec ambient_keys[] = {type_key(ambient_type), color_key("color", required)};
constexpr KeySpec directional_keys[] = {type_key(directional_type),
                                        color_key("color", required),
                                        direction_key("direction", required),
                                        {.name = "angle", .range = {.low = 0, .high = 180}}};
constexpr KeySpec point_keys[] = {type_key(point_type), color_key("color", required), point_key("position", required),
                                  attenuation_key, source_radius_key};
constexpr KeySpec spot_keys[] = {type_key(spot_type),
                                 color_key("color", required),
                                 point_key("position", required),
                                 direction_key("direction", required),
                                 {.name = "cutoff", .required = true, .range = {.low = 0, .high = 180, .low_open = true}},
                                 attenuation_key,
                                 source_radius_key};
constexpr BlockSpec light_blocks[] = {{"ambient", "an ambient light", ambient_keys},
                                      {"directional", "a directional light", directional_keys},
                                      {"point", "a point light", point_keys},
                                      {"spot", "a spot light", spot_keys}};

bool is_positive(const Range& range) { return range.low == 0 && range.low_open; }

std::string describe_range(const Range& range, const std::string& noun) {
    const bool bounded_below = range.low > -largest_magnitude;
    const bool bounded_above = range.high < largest_magnitude;
    if (!bounded_below && !bounded_above) return noun;
    if (!bounded_above)
        return is_positive(range) ? "a positive " + noun.substr(2) : noun + " of " + number_text(range.low) + " or more";
    if (!range.low_open && !range.high_open) return noun + " from " + number_text(range.low) + " to " + number_text(range.high);
    return noun + " greater than " + number_text(range.low) + " and " + (range.high_open ? "less than " : "at most ") +
           number_text(range.high);
}

} // namespace

namespace format {
const BlockSpec scene{"scene", "a scene", scene_keys};
const BlockSpec camera{"camera", "the camera", camera_keys};
const BlockSpec render{"render", "the render block", render_keys};
const BlockSpec anti_aliasing{"anti_aliasing", "the anti_aliasing block", anti_aliasing_keys};
const BlockSpec material{"material", "a material", material_keys};
const std::span<const BlockSpec> shapes{shape_blocks};
const std::span<const BlockSpec> transformations{transformation_blocks};
const std::span<const BlockSpec> lights{light_blocks};
} // namespace format

std::span<const BlockSpec* const> scene_format() {
    static const BlockSpec* const blocks[] = {&format::scene,
                                              &format::camera,
                                              &format::render,
                                              &format::anti_aliasing,
                                              &format::material,
                                              &shape_blocks[0],
                                              &shape_blocks[1],
                                              &shape_blocks[2],
                                              &shape_blocks[3],
                                              &shape_blocks[4],
                                              &transformation_blocks[0],
                                              &transformation_blocks[1],
                                              &transformation_blocks[2],
                                              &light_blocks[0],
                                              &light_blocks[1],
                                              &light_blocks[2],
                                              &light_blocks[3]};
    return blocks;
}

bool is_comment_key(std::string_view key) { return key.starts_with('_') || key == "comment" || key == "$schema"; }

std::string describe_item(const KeySpec& key) {
    return describe_range(key.range, key.kind == whole || key.kind == wholes ? "a whole number" : "a number");
}

std::string describe(const KeySpec& key) {
    switch (key.kind) {
    case number:
    case whole:
        return describe_item(key);
    case boolean:
        return "true or false";
    case text:
        return "a text in double quotes";
    case choice: {
        std::string out = key.choices.size() == 1 ? "" : "one of ";
        for (const std::string_view word : key.choices) out.append(out.ends_with('`') ? ", `" : "`").append(word).append("`");
        return out;
    }
    case switch_or_choice: {
        std::string out = "true, false";
        for (const std::string_view word : key.choices)
            out.append(word == key.choices.back() ? " or `" : ", `").append(word).append("`");
        return out;
    }
    case numbers:
    case wholes:
        return std::string(key.what);
    case block:
        return "an object { ... }";
    case list:
        return "a list [ ... ]";
    }
    return {};
}

bool in_range(const KeySpec& key, double value) {
    const Range& range = key.range;
    if (is_positive(range) && value < smallest_length) return false;
    return (range.low_open ? value > range.low : value >= range.low) &&
           (range.high_open ? value < range.high : value <= range.high);
}

} // namespace lanecast
