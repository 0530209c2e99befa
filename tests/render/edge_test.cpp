// Anti-aliasing at edges only: the picture of the grid for a fraction of its rays.

#include "render/compare.hpp"
#include "render/render_support.hpp"
#include "scene/load_scene.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

const KernelTable& fastest() { return *balanced_kernels().back(); }

Frame sampled(const SceneDescription& scene, Shot shot, AntiAliasMode mode, int samples) {
    shot.settings.anti_aliasing.mode = mode;
    shot.settings.anti_aliasing.samples = samples;
    return shoot(fastest(), scene, shot);
}

double camera_rays(const Frame& frame) {
    const RayKindStats* const kinds = frame.stats.tiles.kinds;
    return static_cast<double>(kinds[static_cast<int>(RayKind::primary)].rays + kinds[static_cast<int>(RayKind::offset)].rays);
}

/// A triangle of one colour before a background of another, with one side, of any slope, through the picture.
SceneDescription half_plane(Random& random, double contrast) {
    SceneDescription scene;
    scene.camera.position = {0, 0, 5};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.field = 40;
    const double dark = random.uniform(0, 0.2); // as seen
    scene.camera.background = glm::dvec3(dark * dark);
    const double angle = random.chance(0.3) ? random.below(8) * 0.78539816339744831 + random.uniform(-1e-2, 1e-2)
                                            : random.uniform(0, 6.283185307179586);
    const glm::dvec3 along(std::cos(angle), std::sin(angle), 0), across(-along.y, along.x, 0);
    const glm::dvec3 middle = across * random.uniform(-1.8, 1.8);
    Object object = make_object(triangle_mesh({{middle - along * 50.0, middle + along * 50.0, middle + across * 50.0}}));
    object.material.ambient = glm::dvec3((dark + contrast) * (dark + contrast));
    scene.objects.push_back(object);
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    return scene;
}

struct Seen {
    double rmse, rays;
};
/// RMSE against `truth`, and camera rays.
Seen judge(const Frame& frame, const Film& truth) { return {compare(frame.film, truth).rmse, camera_rays(frame)}; }

} // namespace

TEST_CASE("edge N is grid N where a straight edge parts two colours: no pixel that it crosses is missed, for few of the rays") {
    Random random(1);
    for (int n = 0; n < cases(600); ++n) {
        const int side = 2 + random.below(7);
        const double limit = 1.0 / (side * side);
        const SceneDescription scene = half_plane(random, random.uniform(1.01 * limit, 0.8));
        const Shot shot{{48 + random.below(30), 48, {0, 0, 0, 0}, 1, 1 + random.below(64)}, {}};
        CAPTURE(n);
        CAPTURE(side);
        const Frame edge = sampled(scene, shot, AntiAliasMode::edge, side),
                    grid = sampled(scene, shot, AntiAliasMode::grid, side);
        CHECK(compare(edge.film, grid.film).largest < 1e-6); // the sums are made in another order
        const double offset = static_cast<double>(edge.stats.tiles.kinds[static_cast<int>(RayKind::offset)].rays);
        const double length = shot.options.width + shot.options.height; // pixels that an edge crosses, at most
        CHECK(offset <= length * (side * side + 5 * 4));
    }
}

TEST_CASE("edge N leaves colours alone that differ, as seen, by less than one of its N x N samples can change") {
    Random random(2);
    for (int side = 2; side <= 8; ++side) {
        const double limit = 1.0 / (side * side);
        const SceneDescription scene = half_plane(random, 0.99 * limit);
        const Shot shot{};
        const Frame edge = sampled(scene, shot, AntiAliasMode::edge, side);
        CHECK(film_difference(edge.film, sampled(scene, shot, AntiAliasMode::off, 1).film) == "");
        CHECK(edge.stats.tiles.kinds[static_cast<int>(RayKind::offset)].rays == 0);
    }
}

TEST_CASE("edge takes what changes evenly for what it is: no ray on a ramp, all the grid on an edge across it") {
    SceneDescription scene; // a floor seen from above, lit from the side: brightness falls along x
    scene.camera.position = {0, 4, 0};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.field = 40;
    Object floor = make_object(Plane{{0, 0, 0}, {0, 1, 0}});
    floor.material.diffuse = glm::dvec3(1);
    scene.objects.push_back(floor);
    scene.lights.emplace_back(PointLight{glm::dvec3(2), {-6, 4, 0}, {1, 0, 0}, 0});
    const Shot shot{};
    const auto offset_rays = [&](const SceneDescription& s) {
        return sampled(s, shot, AntiAliasMode::edge, 8).stats.tiles.kinds[static_cast<int>(RayKind::offset)].rays;
    };
    CHECK(offset_rays(scene) == 0);
    Object post = make_object(Cylinder{0.2, 1});
    post.material.diffuse = glm::dvec3(0.2);
    scene.objects.push_back(post);
    CHECK(offset_rays(scene) > 64 * 10);
}

TEST_CASE("edge reaches the error of 16 uniform samples with a quarter of the camera rays") {
    int scenes = 0;
    for (const std::string name : {"sphere", "cone", "cylinder", "attenuation", "transformations", "near"}) {
        if (++scenes > cases(6)) break;
        CAPTURE(name);
        const LoadedScene loaded = load_scene(LANECAST_SOURCE_DIR "/scenes/" + name + ".json", {});
        const Shot shot{{320, 320, {0, 0, 0, 0}, 2, 32}, loaded.description.render};
        // 13: none of its samples but the centre is one of those that are judged
        const Film truth = sampled(loaded.description, shot, AntiAliasMode::grid, 13).film;
        const Seen uniform = judge(sampled(loaded.description, shot, AntiAliasMode::grid, 4), truth);
        double share = 1;
        for (const int side : {4, 5, 6}) {
            const Seen edge = judge(sampled(loaded.description, shot, AntiAliasMode::edge, side), truth);
            if (edge.rmse <= uniform.rmse) share = std::min(share, edge.rays / uniform.rays);
        }
        MESSAGE(name, ": share of the rays ", share);
        CHECK(share <= 0.25);
    }
}
