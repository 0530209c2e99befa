// Degenerate or not, and normals, against exact and extended arithmetic.

#include "scene/geometry_support.hpp"
#include "scene/triangle_geometry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

namespace {

struct Triangle {
    float v[3][3];
};

/// Integers below 2^20: products and sums are exact in 64 bits.
bool is_degenerate_exactly(const std::int64_t v[3][3]) {
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if ((v[1][i] - v[0][i]) * (v[2][j] - v[0][j]) != (v[1][j] - v[0][j]) * (v[2][i] - v[0][i])) return false;
    }
    return true;
}

/// Float products are exact in long double's 64 bits, so with six exact terms only the sum rounds; here from doubled precision
/// differences.
void normal_extended(const Triangle& t, long double n[3]) {
    using L = long double;
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        const L abi = L(t.v[1][i]) - L(t.v[0][i]), abj = L(t.v[1][j]) - L(t.v[0][j]);
        const L aci = L(t.v[2][i]) - L(t.v[0][i]), acj = L(t.v[2][j]) - L(t.v[0][j]);
        n[axis] = abi * acj - abj * aci;
    }
    const L length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int axis = 0; axis < 3; ++axis) n[axis] /= length;
}

double error_of_normal(const Triangle& t) {
    float normal[3];
    triangle_normal(t.v[0], t.v[1], t.v[2], normal);
    long double expected[3];
    normal_extended(t, expected);
    double worst = 0;
    for (int axis = 0; axis < 3; ++axis)
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(normal[axis]) - expected[axis])));
    return worst;
}

bool is_degenerate(const Triangle& t) { return lanecast::is_degenerate(t.v[0], t.v[1], t.v[2]); }

} // namespace

TEST_CASE("degenerate exactly where integer arithmetic says so, at every power of two") {
    Random random(1);
    int degenerate = 0;
    for (int i = 0; i < 20000; ++i) {
        std::int64_t v[3][3];
        const int range = 1 << random.below(20), multiple = 1 + random.below(5);
        for (auto& p : v)
            for (auto& x : p) x = random.below(2 * range + 1) - range;
        if (random.chance(0.4)) // on the line through the first two, or nearly
            for (int axis = 0; axis < 3; ++axis) v[2][axis] = v[0][axis] + (v[1][axis] - v[0][axis]) * multiple / 2;
        if (random.chance(0.1)) std::copy_n(v[0], 3, v[1]);
        const double scale = std::ldexp(1.0, random.below(100) - 100);
        Triangle t{};
        bool fits = true;
        for (int p = 0; p < 3; ++p)
            for (int axis = 0; axis < 3; ++axis) {
                t.v[p][axis] = static_cast<float>(static_cast<double>(v[p][axis]) * scale);
                fits = fits && static_cast<double>(t.v[p][axis]) == static_cast<double>(v[p][axis]) * scale;
            }
        REQUIRE(fits);
        const bool expected = is_degenerate_exactly(v);
        REQUIRE(is_degenerate(t) == expected);
        degenerate += expected ? 1 : 0;
    }
    CHECK(degenerate > 2000);
    CHECK(degenerate < 15000);
}

TEST_CASE("collinear and one ulp beside it, with coordinates of very different size") {
    // On the line y = x: differences with 1e-30 are not exact in double.
    CHECK(is_degenerate(Triangle{{{0, 0, 0}, {1e-30f, 1e-30f, 0}, {1, 1, 0}}}));
    CHECK_FALSE(is_degenerate(Triangle{{{0, 0, 0}, {1e-30f, std::nextafter(1e-30f, 1.0f), 0}, {1, 1, 0}}}));
    CHECK_FALSE(is_degenerate(Triangle{{{1, 1, 0}, {1e-30f, std::nextafter(1e-30f, 0.0f), 0}, {-1, -1, 0}}}));
    CHECK(is_degenerate(Triangle{{{-1, -1, 0.5f}, {1e-30f, 1e-30f, 0.5f}, {1, 1, 0.5f}}}));
    CHECK_FALSE(is_degenerate(Triangle{{{0, 0, 0}, {1e-44f, 0, 0}, {0, 1e-44f, 0}}})); // denormal, but a triangle
}

TEST_CASE("points on a line through the origin, far closer to it than double can tell, and one ulp beside it") {
    Random random(7);
    for (int i = 0; i < 20000; ++i) {
        const int direction[3] = {1 + random.below(100), -1 - random.below(100), 1 + random.below(100)};
        Triangle t{};
        for (int p = 0; p < 3; ++p) {
            const double along =
                std::ldexp(1 + 2 * random.below(1 << 15), -random.below(80) - p); // different by the power of two
            for (int axis = 0; axis < 3; ++axis) t.v[p][axis] = static_cast<float>((p == 2 ? -along : along) * direction[axis]);
        }
        REQUIRE(is_degenerate(t));
        float& moved = t.v[random.below(3)][random.below(3)];
        moved = std::nextafter(moved, random.chance(0.5) ? 1e9f : -1e9f);
        REQUIRE_FALSE((is_degenerate(t) && t.v[0][0] != t.v[1][0]));
    }
}

TEST_CASE("normals of well-shaped triangles and of needles") {
    Random random(2);
    double worst = 0, worst_needle = 0;
    for (int i = 0; i < 20000; ++i) {
        Triangle t{};
        const double thin = std::pow(10.0, -random.uniform(0, 6)), offset = random.chance(0.5) ? 0 : 1;
        const glm::dvec3 p = random.point(offset), u = random.direction(), w = random.direction() * thin, far = p + u,
                         beside = p + random.uniform(0, 1) * u + w;
        const int first = random.below(3);
        for (int axis = 0; axis < 3; ++axis) {
            t.v[first][axis] = static_cast<float>(p[axis]);
            t.v[(first + 1) % 3][axis] = static_cast<float>(far[axis]);
            t.v[(first + 2) % 3][axis] = static_cast<float>(beside[axis]);
        }
        if (is_degenerate(t)) continue;
        double& own = thin < 1e-2 ? worst_needle : worst;
        own = std::max(own, error_of_normal(t));
    }
    CHECK(worst < 6.1e-8); // half an ulp of a number below 1 is 3e-8
    CHECK(worst_needle < 6.1e-8);
}

TEST_CASE("normals where squares underflow") {
    Triangle t{{{0, 0, 0}, {1e-40f, 0, 0}, {0, 1e-40f, 0}}};
    float normal[3];
    triangle_normal(t.v[0], t.v[1], t.v[2], normal);
    CHECK(normal[0] == 0);
    CHECK(normal[1] == 0);
    CHECK(normal[2] == 1);
}
