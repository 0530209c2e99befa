// Composition, classes, inverses.

#include "scene/geometry_support.hpp"
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

} // namespace

TEST_CASE("transformations are applied first to last") {
    const std::vector<Transformation> chain{Scale{{2, 1, 1}}, Rotation{{0, 0, 1}, 90}, Translation{{0, 0, 5}},
                                            Rotation{{1, 0, 0}, 90}};
    // (1,0,0) -> (2,0,0) -> (0,2,0) -> (0,2,5) -> (0,-5,2)
    CHECK(apply(compose(chain), {1, 0, 0}) == glm::dvec3(0, -5, 2));
    const std::vector<Transformation> moved_first{Translation{{1, 2, 3}}, Scale{{2, 3, -4}}};
    CHECK(apply(compose(moved_first), {1, 1, 1}) == glm::dvec3(4, 9, -16));
    CHECK(apply(compose({}), {1, 2, 3}) == glm::dvec3(1, 2, 3));
}

TEST_CASE("rotations are right-handed, rigid, and exact at quarter turns") {
    CHECK(apply(compose(std::vector<Transformation>{Rotation{{0, 3, 0}, 90}}), {0, 0, 1}) == glm::dvec3(1, 0, 0));
    CHECK(apply(compose(std::vector<Transformation>{Rotation{{0, 0, 2}, -270}}), {1, 0, 0}) == glm::dvec3(0, 1, 0));
    CHECK(apply(compose(std::vector<Transformation>{Rotation{{1, 0, 0}, 720 + 180}}), {0, 1, 0}) == glm::dvec3(0, -1, 0));
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 axis = random.direction(), p = random.point(1);
        const double degrees = random.uniform(-720, 720), angle = degrees * 3.14159265358979323846 / 180;
        const glm::dvec3 q = apply(compose(std::vector<Transformation>{Rotation{axis * random.uniform(0.01, 100), degrees}}), p);
        const glm::dvec3 expected =
            p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) + axis * glm::dot(axis, p) * (1 - std::cos(angle));
        REQUIRE(distance(q, expected) < 1e-13);
    }
}

TEST_CASE("classes, scales, mirrors and inverses of random chains") {
    Random random(2);
    int similarities = 0, mirrors = 0;
    for (int i = 0; i < 5000; ++i) {
        const bool similarity = random.chance(0.5);
        const auto chain = random_transformations(random, similarity);
        double scale = 1;
        bool mirrored = false, stretched = false;
        for (const auto& t : chain)
            if (const auto* s = std::get_if<Scale>(&t)) {
                scale *= std::cbrt(std::abs(s->scale.x * s->scale.y * s->scale.z));
                mirrored ^= s->scale.x * s->scale.y * s->scale.z < 0;
                stretched = stretched || !similarity;
            }
        const AffineTransform t = compose(chain);
        if (!stretched) {
            REQUIRE(classify(t.linear) == TransformClass::similarity);
            ++similarities;
        } else if (chain.size() == 1) {
            REQUIRE(classify(t.linear) == TransformClass::affine);
        }
        REQUIRE(uniform_scale(t.linear) == doctest::Approx(scale).epsilon(1e-12));
        REQUIRE(is_mirroring(t.linear) == mirrored);
        mirrors += mirrored ? 1 : 0;
        const glm::dvec3 p = random.point(1);
        REQUIRE(distance(inverted(t.linear) * (t.linear * p), p) < 1e-13 * condition(t.linear, inverted(t.linear)));
    }
    CHECK(similarities > 1000);
    CHECK(mirrors > 500);
}

TEST_CASE("a similarity up to what a float can tell") {
    CHECK(classify(glm::dmat3(1e-200)) == TransformClass::similarity);
    CHECK(classify(glm::dmat3(1e200)) == TransformClass::similarity);
    glm::dmat3 m(1);
    m[1][1] = 1 + 1e-11;
    CHECK(classify(m) == TransformClass::similarity);
    m[1][1] = 1 + 1e-7;
    CHECK(classify(m) == TransformClass::affine);
    m[1][1] = 1;
    m[2][1] = 1e-3; // shear
    CHECK(classify(m) == TransformClass::affine);
    std::vector<Transformation> many;
    Random random(3);
    for (int i = 0; i < 10000; ++i) many.emplace_back(Rotation{random.direction(), random.uniform(0, 360)});
    CHECK(classify(compose(many).linear) == TransformClass::similarity);
}

TEST_CASE("condition counts what rounding can cost, not stretching along the axes") {
    glm::dmat3 disc(1);
    disc[1][1] = 1e-6;
    CHECK(condition(disc, inverted(disc)) == doctest::Approx(1));
    const glm::dmat3 turned = compose(std::vector<Transformation>{Rotation{{1, 1, 0}, 40}}).linear * disc;
    CHECK(condition(turned, inverted(turned)) > 1e5);
    CHECK_FALSE(is_finite(inverted(glm::dmat3(0))));
}

TEST_CASE("unit vectors of any length") {
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 d = random.direction();
        REQUIRE(distance(unit(d * std::pow(10, random.uniform(-300, 300))), d) < 1e-14);
    }
    CHECK(unit({0, -1e-308, 0}) == glm::dvec3(0, -1, 0));
}
