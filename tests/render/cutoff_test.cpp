// The cutoff: what a ray that is left out weighs is bounded, and how many rays are not.

#include "render/pick.hpp"
#include "render/render_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

namespace {

const KernelTable& fastest() { return *balanced_kernels().back(); }

/// The largest difference, in a channel, between what a mirrored or transmitted ray brings back and the background that would
/// stand for it.
double largest_loss(const PixelTrace& trace, const SceneArrays& arrays) {
    double largest = 0;
    for (const TraceRecord& ray : trace.rays)
        for (int c = 0; c < 3 && ray.level > 0; ++c)
            largest = std::max(largest, std::fabs(static_cast<double>(ray.color[c]) - static_cast<double>(arrays.background[c])));
    return largest;
}

struct Change {
    double largest = 0; ///< of a channel
    double share = 0;   ///< of what the cutoff allows
    std::size_t rays_before = 0, rays_after = 0;
};

/// Of one pixel, by the cutoff.
Change change_of(const SceneArrays& arrays, const Camera& camera, RenderSettings settings, double cutoff, int x, int y) {
    const FrameOptions options{64, 48, {0, 0, 0, 0}, 1, 32};
    settings.cutoff = 0;
    const PixelTrace full = trace_pixel(fastest(), arrays, camera, settings, options, x, y);
    settings.cutoff = cutoff;
    const PixelTrace cut = trace_pixel(fastest(), arrays, camera, settings, options, x, y);
    Change change;
    for (std::size_t c = 0; c < 3; ++c)
        change.largest =
            std::max(change.largest, std::fabs(static_cast<double>(full.color[c]) - static_cast<double>(cut.color[c])));
    const double allowed = cutoff * largest_loss(full, arrays);
    if (change.largest > 1e-6) change.share = change.largest / (allowed + 1e-6); // 1e-6: of sums in float
    change.rays_before = full.rays.size();
    change.rays_after = cut.rays.size();
    return change;
}

/// Panes behind panes: the tree of a pixel has 2^depth leaves.
SceneDescription panes() {
    SceneDescription scene;
    scene.camera.position = {0, 0, 0};
    scene.camera.look_at = {0.1, 0.2, -1};
    for (const double z : {-1.0, -2.0, -3.0, -4.0, 1.0, 2.0}) {
        Object pane = make_object(Plane{{0, 0, z}, {0, 0, 1}});
        pane.material.ambient = glm::dvec3(1);
        pane.material.reflective = glm::dvec3(0.5);
        pane.material.transmissive = glm::dvec3(0.5);
        scene.objects.push_back(pane);
    }
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    return scene;
}

} // namespace

TEST_CASE(
    "cutoff: where paths do not part a pixel changes by less than the cutoff times what the ray left out would have brought") {
    Random random(11);
    double worst = 0;
    std::size_t before = 0, after = 0;
    for (int n = 0; n < cases(60); ++n) {
        SceneDescription scene = random_lit_scene(random, 4 + random.below(12));
        const bool glass = random.chance(0.5);
        for (Object& object : scene.objects) (glass ? object.material.reflective : object.material.transmissive) = glm::dvec3(0);
        RenderSettings settings;
        settings.schlick = random.chance(0.5);
        settings.depth = 3 + random.below(7);
        const SceneArrays arrays = flatten(scene, settings, 1);
        for (int i = 0; i < 40; ++i) {
            const double cutoff = std::pow(2.0, random.uniform(-10, 0));
            const Change change = change_of(arrays, scene.camera, settings, cutoff, random.below(64), random.below(48));
            worst = std::max(worst, change.share);
            CHECK(change.share <= 1.001);
            before += change.rays_before;
            after += change.rays_after;
        }
    }
    MESSAGE("rays left: ", static_cast<double>(after) / static_cast<double>(before), "; nearest to the bound: ", worst);
    CHECK(after < before);
    CHECK(worst > (fewer > 1 ? 0 : 0.2)); // it is not kept by leaving nothing out
}

TEST_CASE("cutoff: where they part, grey materials have at most 1 / cutoff rays a level") {
    const SceneDescription scene = panes();
    RenderSettings settings;
    settings.depth = 12;
    const SceneArrays arrays = flatten(scene, settings, 1);
    for (int k = 1; k <= 10; ++k) {
        const double cutoff = std::ldexp(0.7, -k);
        const Change change = change_of(arrays, scene.camera, settings, cutoff, 32, 24);
        CAPTURE(cutoff);
        CHECK(change.rays_before > 1000);
        CHECK(change.rays_after < change.rays_before);
        CHECK(static_cast<double>(change.rays_after) <= 1 + settings.depth / cutoff);
    }
}

TEST_CASE("cutoff: along a path that never parts, it is a limit of the ray's own weight") {
    SceneDescription scene; // two mirrors face each other
    scene.camera.background = {0, 0, 0};
    for (const double z : {-1.0, 1.0}) {
        Object mirror = make_object(Plane{{0, 0, z}, {0, 0, 1}});
        mirror.material.ambient = glm::dvec3(1);
        mirror.material.reflective = glm::dvec3(0.5);
        scene.objects.push_back(mirror);
    }
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    RenderSettings settings;
    settings.depth = 40;
    const SceneArrays arrays = flatten(scene, settings, 1);
    for (int k = 1; k <= 20; ++k) {
        const Change at = change_of(arrays, scene.camera, settings, std::ldexp(1.0, -k), 32, 24);
        CHECK(at.rays_after == static_cast<std::size_t>(k) + 1); // the last one weighs as much as the cutoff
    }
}
