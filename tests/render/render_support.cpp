#include "render/render_support.hpp"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

namespace lanecast::test {
namespace {

using Color = glm::dvec3;

Material matte(const Color& diffuse) {
    Material m;
    m.ambient = diffuse * 0.2;
    m.diffuse = diffuse;
    return m;
}
Material shiny(const Color& diffuse, double shininess) {
    Material m = matte(diffuse);
    m.specular = Color(0.7, 0.6, 0.5);
    m.shininess = shininess;
    return m;
}
Material mirror_like(const Color& diffuse) {
    Material m = shiny(diffuse, 40);
    m.reflective = Color(0.6, 0.5, 0.4);
    return m;
}
Material glass(double index) {
    Material m;
    m.diffuse = Color(0.05, 0.05, 0.08);
    m.specular = Color(0.5);
    m.shininess = 80;
    m.reflective = Color(0.15, 0.1, 0.1);
    m.transmissive = Color(0.8, 0.7, 0.9);
    m.refraction = index;
    return m;
}

Mesh tetrahedron() {
    const glm::dvec3 a(1, 1, 1), b(1, -1, -1), c(-1, 1, -1), d(-1, -1, 1);
    return triangle_mesh({{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}});
}

Material random_material(Random& random) {
    const auto color = [&] { return Color(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)); };
    Material m = matte(color());
    if (random.chance(0.5)) m = shiny(color(), std::exp(random.uniform(-1, 5)));
    if (random.chance(0.5)) m.reflective = color() * 0.6;
    if (random.chance(0.5)) {
        m.transmissive = color() * 0.9;
        if (random.chance(0.8)) m.refraction = random.chance(0.3) ? random.uniform(0.6, 1) : random.uniform(1, 2.4);
    }
    return m;
}

Shape random_shape(Random& random, int kind, const glm::dvec3& place) {
    switch (kind) {
    case 0:
        return Sphere{random.uniform(0.2, 0.8), place};
    case 1:
        return Sphere{random.uniform(0.2, 0.8), random.point(0.3)};
    case 2:
        if (random.chance(0.5)) return Cylinder{random.uniform(0.1, 0.6), random.uniform(0.1, 1.5), random.chance(0.6)};
        return Cone{random.uniform(0.1, 0.6), random.chance(0.5) ? 0 : random.uniform(0, 0.6), random.uniform(0.1, 1.5),
                    random.chance(0.5)};
    case 3:
        return tetrahedron();
    default:
        return Plane{random.direction() * random.uniform(3, 6), random.direction() * random.uniform(0.2, 4)};
    }
}

} // namespace

SceneDescription everything() {
    SceneDescription scene;
    scene.camera.position = {0.3, 1.4, 5};
    scene.camera.look_at = {0, 0.4, 0};
    scene.camera.field = 50;
    scene.camera.background = {0.1, 0.2, 0.35};
    scene.objects.push_back({Plane{{0, -1, 0}, {0, 2, 0}}, {}, mirror_like({0.4, 0.4, 0.3}), "floor"});
    scene.objects.push_back({Plane{{0, 0, -6}, {0, 0.1, -1}}, {}, matte({0.3, 0.5, 0.4}), "wall seen from behind"});
    scene.objects.push_back({Sphere{1, {-1.2, 0, 0}}, {}, glass(1.5), "glass"});
    scene.objects.push_back({Sphere{0.5, {-1.2, 0, 0}}, {}, glass(0.7), "bubble in the glass"});
    scene.objects.push_back({Sphere{0.7, {1.1, -0.3, 0.4}}, {}, mirror_like({0.2, 0.3, 0.6}), "mirror"});
    scene.objects.push_back({Sphere{},
                             {Scale{{0.5, 1.1, 0.4}}, Rotation{{1, 2, 3}, 40}, Translation{{2.3, 0.3, -1}}},
                             shiny({0.8, 0.2, 0.2}, 12),
                             ""});
    scene.objects.push_back(
        {Cylinder{0.5, 1.4}, {Rotation{{1, 0, 0.3}, 35}, Translation{{0.2, 0.1, -1.6}}}, shiny({0.2, 0.7, 0.3}, 30), ""});
    Material film = matte({0.3, 0.1, 0.4});
    film.transmissive = {0.6, 0.2, 0.7}; // no index: straight through
    scene.objects.push_back({Cylinder{0.3, 0.8}, {Translation{{0.3, 1.4, 0.5}}}, film, ""});
    scene.objects.push_back({Cone{0.4, 0, 0.9}, {Rotation{{1, 0, 1}, 20}, Translation{{1.2, 1.2, -0.4}}}, glass(1.4), "cone"});
    scene.objects.push_back({Cone{0.5, 0.2, 0.7, false},
                             {Scale{{1, 1.2, 0.7}}, Rotation{{0, 0, 1}, 70}, Translation{{-0.3, 0.7, 0.9}}},
                             mirror_like({0.5, 0.4, 0.2}),
                             "funnel"});
    scene.objects.push_back(
        {Cylinder{0.25, 0.8, false}, {Rotation{{1, 0, 0}, 70}, Translation{{-0.6, -0.4, 1.6}}}, film, "pipe"});
    scene.objects.push_back({tetrahedron(),
                             {Scale{{-0.5, 0.6, 0.5}}, Rotation{{0, 1, 0}, 25}, Translation{{0.2, -0.3, 1.4}}},
                             glass(1.3),
                             "mirrored"});
    scene.objects.push_back(
        {tetrahedron(), {Scale{{0.4, 0.4, 0.4}}, Translation{{-2.2, 1.3, -1.5}}}, matte({0.8, 0.7, 0.1}), ""});
    scene.lights.emplace_back(AmbientLight{{0.4, 0.4, 0.5}});
    scene.lights.emplace_back(DirectionalLight{{0.5, 0.5, 0.4}, {-1, -2, -1.5}, 4});
    scene.lights.emplace_back(PointLight{{0.9, 0.8, 0.7}, {2, 3, 3}, {0.5, 0.1, 0.02}, 0.3});
    scene.lights.emplace_back(SpotLight{{0.8, 0.9, 1}, {-2, 4, 2}, {0.8, -2, -1}, 25, {1, 0, 0.01}, 0.2});
    return scene;
}

SceneDescription random_lit_scene(Random& random, int size) {
    SceneDescription scene;
    for (int i = 0; i < size; ++i) {
        const glm::dvec3 place = random.point(2);
        const int kind = random.below(5);
        Object object{random_shape(random, kind, place), {}, random_material(random), ""};
        if (kind >= 1 && kind <= 3) object.transformations = random_transformations(random, kind == 2 && random.chance(0.5));
        if (kind == 3) object.transformations.emplace_back(Scale{glm::dvec3(0.5, 0.5, random.chance(0.5) ? -0.5 : 0.5)});
        if (kind >= 1 && kind <= 3) object.transformations.emplace_back(Translation{kind == 3 ? place : place * 0.5});
        if (random.chance(0.15))
            scene.objects.push_back({Sphere{random.uniform(0.05, 0.2), place}, {}, random_material(random), ""});
        scene.objects.push_back(object);
    }
    const int lights = 1 + random.below(4);
    const auto color = [&] { return Color(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)); };
    if (random.chance(0.7)) scene.lights.emplace_back(AmbientLight{color()});
    for (int i = 0; i < lights; ++i) {
        const std::array<double, 3> falloff =
            random.chance(0.5) ? std::array<double, 3>{1, 0, 0}
                               : std::array<double, 3>{random.uniform(0.2, 1), random.uniform(0, 0.2), random.uniform(0, 0.05)};
        switch (random.below(3)) {
        case 0:
            scene.lights.emplace_back(DirectionalLight{color(), random.direction() * random.uniform(0.1, 9), 0});
            break;
        case 1:
            scene.lights.emplace_back(PointLight{color(), random.point(6), falloff, 0});
            break;
        default: {
            const glm::dvec3 place = random.direction() * random.uniform(3, 6);
            scene.lights.emplace_back(
                SpotLight{color(), place, random.point(1) - place, random.chance(0.1) ? 120 : random.uniform(5, 60), falloff, 0});
        }
        }
    }
    scene.camera.position = random.direction() * random.uniform(0.5, 4);
    scene.camera.look_at = random.point(0.5);
    scene.camera.up = random.direction();
    scene.camera.field = random.uniform(20, 100);
    scene.camera.background = color();
    if (random.chance(0.3)) scene.camera.near = random.uniform(0, 3);
    return scene;
}

Frame shoot(const KernelTable& kernels, const SceneDescription& scene, const Shot& shot) {
    const SceneArrays arrays = flatten(scene, shot.settings, 1);
    return render_frame(kernels, arrays, scene.camera, shot.settings, shot.options);
}

std::string film_difference(const Film& whole, const Film& part) {
    for (int y = part.y0; y < part.y0 + part.height; ++y)
        for (int x = part.x0; x < part.x0 + part.width; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const float a = whole.rgb[c][static_cast<std::size_t>((y - whole.y0) * whole.width + x - whole.x0)];
                const float b = part.rgb[c][static_cast<std::size_t>((y - part.y0) * part.width + x - part.x0)];
                if (!std::isfinite(a)) return "a pixel is not finite";
                if (bits_of(a) != bits_of(b)) {
                    char text[120];
                    std::snprintf(text, sizeof text, "pixel %d,%d channel %d: %.9g and %.9g", x, y, static_cast<int>(c),
                                  static_cast<double>(a), static_cast<double>(b));
                    return text;
                }
            }
    return "";
}

std::vector<AntiAliasing> anti_aliasings() {
    return {{AntiAliasMode::off, 4, 0.25, true},    {AntiAliasMode::cross, 4, 1.0 / 3, true},
            {AntiAliasMode::cross, 4, 1.25, false}, {AntiAliasMode::grid, 2, 0.25, true},
            {AntiAliasMode::grid, 3, 0.25, true},   {AntiAliasMode::edge, 2, 0.25, true}};
}

const char* name_of(AntiAliasMode mode) {
    switch (mode) {
    case AntiAliasMode::cross:
        return "cross";
    case AntiAliasMode::grid:
        return "grid";
    case AntiAliasMode::edge:
        return "edge";
    case AntiAliasMode::off:
        break;
    }
    return "off";
}

} // namespace lanecast::test
