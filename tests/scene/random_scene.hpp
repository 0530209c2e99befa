#pragma once
// Random valid scenes: every key takes every kind of value it may have, ends of ranges included.

#include "scene/description.hpp"

#include <cmath>
#include <random>
#include <utility>

namespace lanecast {

class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : random_(seed) {}

    SceneDescription scene() {
        SceneDescription out;
        out.camera = camera();
        for (int i = whole(0, 4); i > 0; --i) out.objects.push_back(object());
        bool ambient = false;
        for (int i = whole(0, 4); i > 0; --i) {
            Light next = light();
            if (std::holds_alternative<AmbientLight>(next) && std::exchange(ambient, true)) continue;
            out.lights.push_back(next);
        }
        out.render = render();
        return out;
    }

    int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
    double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    bool coin() { return whole(0, 1) == 1; }

    /// Of any magnitude up to 1e12, often a small whole number.
    double any() {
        if (coin()) return whole(-5, 5);
        return (coin() ? 1 : -1) * positive();
    }
    double positive() { return coin() ? whole(1, 9) : std::pow(10.0, real(-12, 12)); }
    double not_negative() { return whole(0, 4) == 0 ? 0 : positive(); }
    glm::dvec3 point() { return {any(), any(), any()}; }
    glm::dvec3 color() { return {not_negative(), not_negative(), not_negative()}; }
    glm::dvec3 direction() {
        glm::dvec3 out{};
        while (out == glm::dvec3{0}) out = point();
        return out;
    }

    glm::dvec3 share() { return {real(0, 1e6), coin() ? 0 : 1e6, real(0, 1)}; }
    Material material() { return {color(), color(), color(), share(), share(), not_negative(), not_negative()}; }

    Transformation transformation() {
        // Factors near 1, so that a few composed ones stay invertible.
        const auto factor = [&] { return (coin() ? 1 : -1) * std::pow(10.0, real(-2, 2)); };
        switch (whole(0, 2)) {
        case 0:
            return Rotation{direction(), real(-720, 720)};
        case 1:
            return Scale{{factor(), factor(), factor()}};
        default:
            return Translation{point()};
        }
    }

    Mesh mesh() {
        Mesh out;
        for (std::uint32_t i = static_cast<std::uint32_t>(whole(1, 5)); i > 0; --i) {
            const auto first = static_cast<std::uint32_t>(out.positions.size());
            for (int corner = 0; corner < 3; ++corner) out.positions.push_back(point());
            out.triangles.push_back({first, first + 1, first + 2});
        }
        return out;
    }

    Object object() {
        Object out;
        out.material = material();
        if (coin()) out.name = coin() ? "ball" : "tab\t\"quote\" \\ caf\u00e9 \U0001F600";
        switch (whole(0, 4)) {
        case 0:
            out.shape = Sphere{positive(), point()};
            break;
        case 1:
            out.shape = Cylinder{positive(), positive(), coin()};
            break;
        case 2:
            out.shape = Cone{positive(), not_negative(), positive(), coin()};
            break;
        case 3:
            out.shape = Plane{point(), direction()};
            return out;
        default:
            out.shape = mesh();
        }
        for (int i = whole(0, 3); i > 0; --i) out.transformations.push_back(transformation());
        return out;
    }

    Light light() {
        const std::array<double, 3> attenuation{positive(), not_negative(), not_negative()};
        switch (whole(0, 3)) {
        case 0:
            return AmbientLight{color()};
        case 1:
            return DirectionalLight{color(), direction(), coin() ? 180 : real(0, 180)};
        case 2:
            return PointLight{color(), point(), attenuation, not_negative()};
        default:
            return SpotLight{color(), point(), direction(), coin() ? 180 : real(1e-6, 180), attenuation, not_negative()};
        }
    }

    Camera camera() {
        Camera out;
        out.field = real(1e-6, 179.999999);
        out.background = color();
        out.position = point();
        // Far from parallel to `up` and from the position.
        out.up = {0, positive(), 0};
        out.look_at = out.position + glm::dvec3(0, 0, 1e13);
        out.near = not_negative();
        out.resolution = {whole(1, 4) == 1 ? 65536 : whole(1, 4096), whole(1, 4096)};
        return out;
    }

    RenderSettings render() {
        RenderSettings out;
        for (bool* const value :
             {&out.ambient, &out.diffuse, &out.specular, &out.shadows, &out.transmissive_shadows, &out.reflections,
              &out.transmission, &out.refraction, &out.schlick, &out.planes, &out.anti_aliasing.planes})
            *value = coin();
        out.bvh = static_cast<BvhMode>(whole(0, 2));
        out.anti_aliasing.mode = static_cast<AntiAliasMode>(whole(0, 3));
        out.anti_aliasing.samples = whole(1, 64);
        out.anti_aliasing.offset = coin() ? 16 : real(1e-9, 16);
        out.soft_shadows = whole(0, 1024);
        out.depth = whole(0, 1024);
        out.cutoff = coin() ? whole(0, 1) : real(0, 1);
        out.precision = static_cast<Precision>(whole(0, 2));
        return out;
    }

private:
    std::mt19937_64 random_;
};

} // namespace lanecast
