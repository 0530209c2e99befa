// Penumbrae against their exact values, and against what independent random points would make of them.

#include "render/render_support.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr double pi = 3.14159265358979324;

/// A floor at y = 0 seen from above, a light with an extent over it, and between them a half-plane that ends in a straight edge.
struct Penumbra {
    glm::dvec3 lamp, on_edge, along;
    double radius = 0;

    /// x and z of the floor point in the middle of a pixel.
    static glm::dvec3 floor_point(int x, int y) { return {(x + 0.5 - 32) / 48 * 1.8, 0, (y + 0.5 - 24) / 48 * 1.8}; }

    /// Of the lamp's disc, which faces the point, as seen past the edge: the plane through the point and the edge cuts it along a
    /// chord.
    [[nodiscard]] double visible(const glm::dvec3& p) const {
        const glm::dvec3 to_lamp = lamp - p, w = glm::normalize(to_lamp);
        const glm::dvec3 normal = glm::cross(on_edge - p, along); // towards the open side
        const double slope = glm::length(normal - w * glm::dot(normal, w));
        const double e = glm::dot(normal, to_lamp) / slope / radius; // of the centre from the chord, in radii
        if (e >= 1) return 1;
        if (e <= -1) return 0;
        return 1 - (std::acos(e) - e * std::sqrt(1 - e * e)) / pi;
    }
};

Penumbra random_penumbra(Random& random) {
    Penumbra p;
    const double angle = random.uniform(0, 2 * pi), height = random.uniform(1, 3);
    p.lamp = {random.uniform(-1, 1), 4, random.uniform(-1, 1)};
    p.along = {std::cos(angle), 0, std::sin(angle)};
    p.on_edge = {0.5 * random.uniform(-1, 1), height, 0.5 * random.uniform(-1, 1)};
    p.radius = random.uniform(0.3, 1.2);
    return p;
}

SceneDescription scene_of(const Penumbra& p) {
    SceneDescription scene;
    scene.camera.position = {0, 0.9, 0}; // below the half-plane
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.field = 90;
    Object floor = make_object(Plane{{0, 0, 0}, {0, 1, 0}});
    floor.material.diffuse = glm::dvec3(1);
    scene.objects.push_back(floor);
    const glm::dvec3 behind = glm::cross(p.along, glm::dvec3(0, 1, 0)) * 100.0; // the covered side
    const glm::dvec3 a = p.on_edge - p.along * 100.0, b = p.on_edge + p.along * 100.0;
    scene.objects.push_back(make_object(triangle_mesh({{a, b, b + behind}, {a, b + behind, a + behind}})));
    scene.lights.emplace_back(PointLight{glm::dvec3(1), p.lamp, {1, 0, 0}, p.radius});
    return scene;
}

struct Errors {
    double ours = 0, random = 0; ///< sums of squares over pixels in penumbrae
    double bias = 0;             ///< towards hard shadows: sum of what the brighter half has too much and the darker too little
    int pixels = 0;
};

/// Adds the errors of n of our points, and of m independent ones, over the penumbra of one scene.
void add_errors(Errors& errors, const Penumbra& p, int n, int m, Random& random) {
    const SceneDescription scene = scene_of(p);
    Shot shot{};
    shot.settings.soft_shadows = n;
    const Film shaded = shoot(*balanced_kernels().back(), scene, shot).film;
    shot.settings.shadows = false;
    const Film bright = shoot(*balanced_kernels().back(), scene, shot).film;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto i = static_cast<std::size_t>(y * 64 + x);
            const double truth = p.visible(Penumbra::floor_point(x, y));
            if (truth <= 0 || truth >= 1 || !(bright.rgb[0][i] > 0)) continue;
            const double ours = static_cast<double>(shaded.rgb[0][i]) / static_cast<double>(bright.rgb[0][i]) - truth;
            int seen = 0;
            for (int k = 0; k < m; ++k) seen += random.chance(truth);
            const double other = static_cast<double>(seen) / m - truth;
            errors.ours += ours * ours;
            errors.bias += truth > 0.5 ? ours : -ours;
            errors.random += other * other;
            ++errors.pixels;
        }
}

} // namespace

TEST_CASE("soft shadows reach the error of independent random points with a tenth of the rays") {
    // at 36 points and more; what fewer do, at least
    struct Claim {
        int points;
        double times;
    };
    for (const auto& [points, times] : {Claim{4, 2}, {8, 3.5}, {16, 5.5}, {36, 10}, {64, 12.5}, {144, 18}}) {
        Random random(3);
        Errors errors;
        for (int i = 0; i < 12; ++i)
            add_errors(errors, random_penumbra(random), points, static_cast<int>(std::lround(points * times)), random);
        CAPTURE(points);
        REQUIRE(errors.pixels > 300);
        MESSAGE(points, " points do as ", points * times * errors.random / errors.ours,
                " random ones: ", times * errors.random / errors.ours, " times as many; RMSE ",
                std::sqrt(errors.ours / errors.pixels));
        CHECK(errors.ours <= errors.random);
    }
}

TEST_CASE("soft shadows are right in the mean, whatever the number of points") {
    for (const int points : {1, 2, 3, 5, 16}) {
        Random random(4);
        Errors errors;
        for (int i = 0; i < 12; ++i) add_errors(errors, random_penumbra(random), points, 1, random);
        const double rmse = std::sqrt(errors.ours / errors.pixels);
        CAPTURE(points);
        CHECK(std::fabs(errors.bias / errors.pixels) < 5 * rmse / std::sqrt(static_cast<double>(errors.pixels)));
    }
}
