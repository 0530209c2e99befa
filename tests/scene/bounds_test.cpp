// Boxes of quadrics against points on the true, unrounded bodies.

#include "scene/geometry_support.hpp"
#include "scene/normalise.hpp"
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

TEST_CASE("rounding outwards") {
    CHECK(rounded_down(0.1) < 0.1);
    CHECK(rounded_up(0.1) > 0.1);
    CHECK(rounded_up(0.1) == std::nextafter(rounded_down(0.1), 1.0f));
    CHECK(rounded_down(0.5) == 0.5f);
    CHECK(rounded_up(-0.5) == -0.5f);
    CHECK(rounded_down(-1e-60) < 0);
}

TEST_CASE("boxes contain points of transformed spheres, cylinders and cones, and are tight") {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        SceneDescription scene;
        const int kind = random.below(3);
        const double radius = std::exp(random.uniform(-3, 3)), height = std::exp(random.uniform(-3, 3));
        const glm::dvec3 position = random.point(3);
        const double apex = kind == 1 ? radius : random.chance(0.5) ? 0 : random.uniform(0, 2 * radius);
        const Shape shape = kind == 0   ? Shape(Sphere{radius, position})
                            : kind == 1 ? Shape(Cylinder{radius, height})
                                        : Shape(Cone{radius, apex, height, random.chance(0.5)});
        const Object object = make_object(shape, random_transformations(random, random.chance(0.3)));
        scene.objects.push_back(object);
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        const auto& root = *reinterpret_cast<const BvhNode*>(arrays.arena.get());
        const AffineTransform t = compose(object.transformations);
        double reach[6] = {-1e30, -1e30, -1e30, -1e30, -1e30, -1e30};
        for (int sample = 0; sample < 400; ++sample) {
            glm::dvec3 p = random.direction() * radius + position;
            if (kind > 0) {
                const double angle = random.uniform(0, 6.3), y = random.chance(0.5) ? 0.5 : -0.5, r = y < 0 ? radius : apex;
                p = {r * std::cos(angle), y * height, r * std::sin(angle)};
            }
            const glm::dvec3 q = normalised(arrays.normalisation, apply(t, p));
            for (int axis = 0; axis < 3; ++axis) {
                REQUIRE(q[axis] >= double{root.lo[axis][0]});
                REQUIRE(q[axis] <= double{root.hi[axis][0]});
                reach[axis] = std::max(reach[axis], -q[axis]);
                reach[axis + 3] = std::max(reach[axis + 3], q[axis]);
            }
        }
        for (int axis = 0; axis < 3; ++axis) { // samples come near every face
            const double extent = double{root.hi[axis][0]} - double{root.lo[axis][0]};
            REQUIRE(-reach[axis] - double{root.lo[axis][0]} < 0.1 * extent);
            REQUIRE(double{root.hi[axis][0]} - reach[axis + 3] < 0.1 * extent);
        }
    }
}
