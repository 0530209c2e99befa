#include "cli/pick_report.hpp"

#include "cli/json_writer.hpp"
#include "cli/names.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cstdio>
#include <span>

namespace lanecast {
namespace {

constexpr const char* ray_names[ray_kind_count] = {"camera", "offset", "shadow", "reflection", "refraction"};

template <class T>
std::string numbers(const std::array<T, 3>& v) {
    char text[96];
    std::snprintf(text, sizeof text, "%.6g %.6g %.6g", static_cast<double>(v[0]), static_cast<double>(v[1]),
                  static_cast<double>(v[2]));
    return text;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

bool is_zero(const std::array<float, 3>& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

std::string object_text(const RayNode& ray, const SceneDescription& scene) {
    const Object& object = scene.objects[static_cast<std::size_t>(*ray.object)];
    std::string text = "object " + std::to_string(*ray.object);
    if (!object.name.empty()) text += " \"" + printable(object.name) + "\"";
    text += std::string(", ") + type_name(object.shape);
    return ray.triangle ? text + ", triangle " + std::to_string(*ray.triangle) : text;
}

bool has_child(const PixelTree& tree, const RayNode& ray, RayKind kind) {
    return std::ranges::any_of(ray.children, [&](std::size_t child) { return tree.rays[child].kind == kind; });
}

class TextReport {
public:
    TextReport(const PixelTree& tree, const SceneDescription& scene) : tree_(tree), scene_(scene) {}

    std::string text() {
        if (!tree_.rays.empty()) add_ray(tree_.rays.front(), 0);
        return std::move(text_);
    }

private:
    void line(int indent, const std::string& label, const std::string& value) {
        text_ += std::string(static_cast<std::size_t>(indent), ' ') + label;
        if (!value.empty()) text_ += std::string(label.size() < 10 ? 10 - label.size() : 1, ' ') + value;
        text_ += '\n';
    }

    void add_lights(const RayNode& ray, int indent) {
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const std::string label = "light " + std::to_string(i);
            const std::string type = type_name(scene_.lights[i]);
            if (std::holds_alternative<AmbientLight>(scene_.lights[i])) {
                line(indent, label, type + ": " + numbers(ray.ambient));
                continue;
            }
            const auto share = std::ranges::find(ray.lights, static_cast<int>(i), &LightShare::light);
            if (share == ray.lights.end())
                line(indent, label, type + ": behind the surface or outside its cone");
            else
                line(indent, label, type + ": " + numbers(share->color) + ", visibility " + numbers(share->visibility));
        }
    }

    void add_untraced(const RayNode& ray, RayKind kind, const std::array<float, 3>& factor, int indent) {
        if (is_zero(factor) || has_child(tree_, ray, kind)) return;
        line(indent, std::string(ray_names[static_cast<int>(kind)]) + " ray not traced, past depth or cutoff: the background",
             "");
    }

    void add_ray(const RayNode& ray, int indent) {
        line(indent, std::string(ray_names[static_cast<int>(ray.kind)]) + " ray, level " + std::to_string(ray.level), "");
        indent += 2;
        line(indent, "from", numbers(ray.org) + " towards " + numbers(ray.dir));
        if (!ray.object) {
            line(indent, "hit", "nothing: the background");
            line(indent, "color", numbers(ray.color));
            return;
        }
        line(indent, "hit", object_text(ray, scene_));
        line(indent, "distance", number(ray.distance) + (ray.inside ? ", from inside" : ", from outside"));
        line(indent, "point", numbers(ray.point));
        line(indent, "normal", numbers(ray.normal));
        add_lights(ray, indent);
        if (!is_zero(ray.reflective))
            line(indent, "reflects",
                 numbers(ray.reflective) +
                     (ray.fresnel != 1 ? " times Fresnel's " + number(static_cast<double>(ray.fresnel)) : ""));
        if (!is_zero(ray.transmissive)) line(indent, "transmits", numbers(ray.transmissive));
        line(indent, "color", numbers(ray.color));
        for (const std::size_t child : ray.children) add_ray(tree_.rays[child], indent);
        add_untraced(ray, RayKind::reflection, ray.reflective, indent);
        add_untraced(ray, RayKind::refraction, ray.transmissive, indent);
    }

    const PixelTree& tree_;
    const SceneDescription& scene_;
    std::string text_;
};

template <class T>
void add(JsonWriter& json, const char* key, const std::array<T, 3>& v) {
    json.add_numbers(key, std::span<const T>(v));
}

void add_surface(JsonWriter& json, const RayNode& ray, const SceneDescription& scene) {
    const Object& object = scene.objects[static_cast<std::size_t>(*ray.object)];
    json.add("object", *ray.object);
    json.add("type", type_name(object.shape));
    json.add("name", object.name);
    if (ray.triangle) json.add("triangle", *ray.triangle);
    json.add("distance", ray.distance);
    add(json, "point", ray.point);
    add(json, "normal", ray.normal);
    json.add("inside", ray.inside);
    add(json, "ambient", ray.ambient);
    json.open_list("lights");
    for (const LightShare& share : ray.lights) {
        json.open_object();
        json.add("light", share.light);
        json.add("type", type_name(scene.lights[static_cast<std::size_t>(share.light)]));
        add(json, "visibility", share.visibility);
        add(json, "color", share.color);
        json.close_object();
    }
    json.close_list();
    add(json, "reflective", ray.reflective);
    json.add("fresnel", ray.fresnel);
    add(json, "transmissive", ray.transmissive);
}

void add_ray(JsonWriter& json, const char* key, const PixelTree& tree, const RayNode& ray, const SceneDescription& scene) {
    json.open_object(key);
    json.add("kind", ray_names[static_cast<int>(ray.kind)]);
    json.add("level", ray.level);
    add(json, "from", ray.org);
    add(json, "towards", ray.dir);
    if (ray.object)
        add_surface(json, ray, scene);
    else
        json.add_null("object");
    add(json, "color", ray.color);
    json.open_list("children");
    for (const std::size_t child : ray.children) add_ray(json, "", tree, tree.rays[child], scene);
    json.close_list();
    json.close_object();
}

} // namespace

std::string pick_text(const PickedPixel& pixel, const SceneDescription& scene) {
    return "pixel (" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ") of " + std::to_string(pixel.width) + "x" +
           std::to_string(pixel.height) + ": " + numbers(pixel.tree.color) + "\n" + TextReport(pixel.tree, scene).text();
}

std::string pick_json(const PickedPixel& pixel, const SceneDescription& scene) {
    JsonWriter json;
    json.open_object();
    const int at[] = {pixel.x, pixel.y}, size[] = {pixel.width, pixel.height};
    json.add_numbers("pixel", std::span<const int>(at));
    json.add_numbers("size", std::span<const int>(size));
    add(json, "color", pixel.tree.color);
    if (pixel.tree.rays.empty())
        json.add_null("ray");
    else
        add_ray(json, "ray", pixel.tree, pixel.tree.rays.front(), scene);
    json.close_object();
    return json.finished();
}

} // namespace lanecast
