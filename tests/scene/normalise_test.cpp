// Centre and scale: exact, covariant under powers of two, sound at the extremes.

#include "cli/selftest/scenes.hpp"
#include "scene/error.hpp"
#include "scene/geometry_support.hpp"
#include "scene/normalise.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

namespace {

DoubleBox box(const glm::dvec3& lo, const glm::dvec3& hi) { return {lo, hi}; }

Object plane_at(const glm::dvec3& position) { return make_object(Plane{position, {0, 1, 0}}); }

} // namespace

TEST_CASE("bounded geometry lies within 1, and beyond 1/4 somewhere") {
    Random random(1);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 a = random.point(std::exp(random.uniform(-20, 20))),
                         size = random.direction() * std::exp(random.uniform(-20, 20));
        DoubleBox bounds;
        include(bounds, a);
        include(bounds, a + size);
        SceneDescription scene;
        scene.camera.position = a;
        const Normalisation n = find_normalisation(bounds, scene, true);
        int e = 0;
        REQUIRE(std::frexp(n.scale, &e) == 0.5);
        double largest = 0;
        for (const glm::dvec3& corner : {bounds.lo, bounds.hi})
            for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(normalised(n, corner)[axis]));
        REQUIRE(largest <= 1);
        REQUIRE(largest >= 0.25);
    }
}

TEST_CASE("the centre is as round as the scale allows") {
    const SceneDescription scene;
    const Normalisation at_origin = find_normalisation(box({-0.3, 0, -0.9}, {0.7, 0.9, 0.8}), scene, true);
    CHECK(at_origin.centre == glm::dvec3(0, 0, 0));
    CHECK(at_origin.scale == 1);
    const Normalisation off = find_normalisation(box({99.3, -1, -1}, {100.9, 1, 0.5}), scene, true);
    CHECK(off.centre == glm::dvec3(100, 0, 0));
    CHECK(off.scale == 1);
    CHECK(is_exact(off, {99.25, 0.5, 0}));
    CHECK(is_exact(off, {static_cast<double>(99.3f), 0.1, 0.2}));
    CHECK_FALSE(is_exact(off, {1e-17, 0, 0}));
}

TEST_CASE("without bounded geometry the places of camera, lights and planes decide") {
    SceneDescription scene;
    scene.camera.position = {0, 4, 0};
    scene.objects.push_back(plane_at({0, -4, 0}));
    const Normalisation n = find_normalisation({}, scene, true);
    CHECK(n.centre.y == 0);
    CHECK(n.scale == 0.25);
    CHECK(find_normalisation({}, SceneDescription{}, true).scale == 1); // look_at is 1 away
}

TEST_CASE("what is far away stays below 2^40, enlarges the extent, or is refused by name") {
    SceneDescription scene;
    const DoubleBox bounds = box({-1, -1, -1}, {1, 1, 1});
    scene.objects.push_back(plane_at({0x1p39, -0x1p39, 0}));
    CHECK(find_normalisation(bounds, scene, true).scale == 1);
    scene.objects.push_back(plane_at({0, 0x1p55, 0}));
    CHECK(find_normalisation(bounds, scene, true).scale == 0x1p-15);
    CHECK(find_normalisation(bounds, scene, false).scale == 1); // planes are left out
    scene.objects[1] = plane_at({0x1p80, 5, 0});                // far along itself only
    CHECK(find_normalisation(bounds, scene, true).scale == 1);
    scene.lights.emplace_back(PointLight{{1, 1, 1}, {0, 0, 0x1p61}, {1, 0, 0}, 0});
    try {
        (void)find_normalisation(bounds, scene, true);
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::scene);
        CHECK(std::string(error.what()).find("/lights/0") != std::string::npos);
    }
    scene.lights.clear();
    scene.camera.position.x = 1e300;
    CHECK_THROWS_WITH_AS((void)find_normalisation(bounds, scene, true), doctest::Contains("/camera"), Error);
    CHECK_THROWS_AS((void)find_normalisation(box({-1e308, 0, 0}, {1e308, 1, 1}), SceneDescription{}, true), Error);
    CHECK_THROWS_AS((void)find_normalisation(box({0, 0, 0}, {1e-300, 0, 0}), SceneDescription{}, true), Error);
}

TEST_CASE("every length times 2^k gives the same bits") {
    Random random(2);
    for (int i = 0; i < 400; ++i) {
        SceneDescription scene = random_scene(random, 1 + random.below(40));
        scene.camera.position = random.point(5);
        scene.lights.emplace_back(PointLight{{1, 1, 1}, random.point(4), {1, random.uniform(0, 1), random.uniform(0, 1)}, 0.1});
        scene.lights.emplace_back(SpotLight{{1, 2, 3}, random.point(4), random.direction(), 30, {0, 1, 0.5}, 0});
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        for (const int k : {-60, -20 - random.below(40), -1, 1, 7, random.below(60), 60}) {
            const SceneArrays scaled = flatten(selftest::scaled_scene(scene, k), scene.render, 1);
            INFO("scene " << i << ", 2^" << k);
            REQUIRE(difference(arrays, scaled) == "");
            REQUIRE(scaled.normalisation.scale == std::ldexp(arrays.normalisation.scale, -k));
        }
    }
}
