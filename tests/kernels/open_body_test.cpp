// Cones and cylinders, open and closed, as bodies in a scene: an open one against its side in long double, rays that go on from
// its inside, and no leak in a closed one.

#include "kernels/kernel_support.hpp"
#include "kernels/traced_batch.hpp"
#include "render/kernels/surface.hpp"
#include "scene/flatten.hpp"
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
using Batch = TracedBatch<F>;
constexpr std::uint32_t W = width<F>;
using Real = long double;

glm::dvec3 direction(Lottery& random) {
    const auto d = random.direction();
    return {d[0], d[1], d[2]};
}

/// One body in a scene of its own, and its side in double: x^2 + z^2 = (1 + taper y)^2, |y| <= 1/2, in object space.
struct Lone {
    SceneArrays arrays;
    SceneView scene{};
    glm::dmat3 object_from_world{};
    glm::dvec3 translation{};
    double taper = 0;

    explicit Lone(const Object& object) {
        SceneDescription description;
        description.objects = {object};
        arrays = flatten(description, RenderSettings{}, 1);
        scene = view(arrays);
        const AffineRecord& r = scene.affines[0];
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                object_from_world[column][row] = double{r.object_from_world[3 * row + column]};
        translation = {r.translation[0], r.translation[1], r.translation[2]};
        taper = double{r.taper};
    }
    /// Both ends on the side, later than `after`; `doubtful`: a rim, a graze or the tip is too near to tell.
    [[nodiscard]] std::vector<double> side_hits(const glm::dvec3& org, const glm::dvec3& dir, double after,
                                                bool& doubtful) const {
        const glm::dvec3 o = object_from_world * (org - translation), d = object_from_world * dir;
        const Real rho = 1 + static_cast<Real>(taper) * o.y, slope = static_cast<Real>(taper) * d.y;
        const Real a = Real{d.x} * d.x + Real{d.z} * d.z - slope * slope, b = Real{o.x} * d.x + Real{o.z} * d.z - rho * slope;
        const Real c = Real{o.x} * o.x + Real{o.z} * o.z - rho * rho, disc = b * b - a * c;
        const Real size = Real{d.x} * d.x + Real{d.z} * d.z + slope * slope;
        doubtful =
            std::fabs(disc) < 1e-5L * size * (Real{o.x} * o.x + Real{o.z} * o.z + rho * rho) || std::fabs(a) < 1e-4L * size;
        std::vector<double> hits;
        if (disc < 0) return hits;
        for (const Real sign : {-1.0L, 1.0L}) {
            const Real t = (-b + sign * std::sqrt(disc)) / a, y = o.y + t * d.y;
            doubtful |= std::fabs(std::fabs(y) - 0.5L) < 1e-4L ||
                        (std::fabs(t - static_cast<Real>(after)) * std::sqrt(size) < 1e-4L && after == 0);
            if (t > static_cast<Real>(after) && std::fabs(y) < 0.5L) hits.push_back(static_cast<double>(t));
        }
        std::sort(hits.begin(), hits.end());
        return hits;
    }
};

Object random_body(Lottery& random, bool capped) {
    Object object;
    const double apex = random.chance(0.3) ? 0 : random.uniform(0.05, 1.5);
    if (random.chance(0.3))
        object.shape = Cylinder{random.uniform(0.3, 1), random.uniform(0.3, 2), capped};
    else
        object.shape = Cone{random.uniform(0.3, 1), apex, random.uniform(0.3, 2), capped};
    if (random.chance(0.5)) object.transformations.emplace_back(Scale{{random.uniform(0.4, 1.5), -random.uniform(0.4, 1.5), 1}});
    object.transformations.emplace_back(Rotation{direction(random), random.uniform(0, 360)});
    object.transformations.emplace_back(Translation{direction(random) * 3.0});
    return object;
}

} // namespace

TEST_CASE("open cones and cylinders: nearest of the side's hits, under any transformation, from outside and inside") {
    Lottery random(7);
    const FlushDenormals flush;
    const auto scratch = std::make_unique<TraceScratch<F>>();
    std::uint64_t rays = 0, hits = 0, far_ends = 0, wrong = 0;
    double worst = 0;
    for (int n = 0; n < cases(300); ++n) {
        const Lone body(random_body(random, false));
        REQUIRE(body.scene.first_slot[6] == 1);
        REQUIRE(body.scene.first_slot[5] == 0);
        Batch first;
        for (std::uint32_t i = 0; i < batch; ++i) {
            const glm::dvec3 o = direction(random) * random.uniform(0, 3);
            first.set(i, o, direction(random) * random.uniform(0, 0.5) - o);
        }
        first.trace_in<Query::closest>(body.scene, *scratch);
        for (std::uint32_t i = 0; i < batch; ++i) {
            bool doubtful = false;
            const std::vector<double> truth = body.side_hits(first.org(i), first.dir(i), 0, doubtful);
            if (doubtful) continue;
            ++rays;
            wrong += truth.empty() != (first.slot[i] < 0);
            if (truth.empty() || first.slot[i] < 0) continue;
            ++hits;
            far_ends += truth.size() == 1;
            worst = std::max(worst, std::fabs(static_cast<double>(first.rays.t[i]) - truth[0]) / (1 + truth[0]));
        }
    }
    CHECK(wrong == 0);
    CHECK(worst < 1e-5);
    CHECK(hits > rays / 4);
    CHECK(far_ends > hits / 20); // in through the open end, or from within
}

TEST_CASE("open cones and cylinders: rays that go on from either side meet what is left of the side, and never themselves") {
    Lottery random(8);
    const FlushDenormals flush;
    const auto scratch = std::make_unique<TraceScratch<F>>();
    std::uint64_t outside = 0, inside = 0, met = 0, wrong = 0, wrong_side = 0;
    for (int n = 0; n < cases(300); ++n) {
        const Lone body(random_body(random, false));
        Batch first, next;
        for (std::uint32_t i = 0; i < batch; ++i) {
            const glm::dvec3 o = direction(random) * random.uniform(0, 2);
            first.set(i, o, direction(random) * random.uniform(0, 0.5) - o);
        }
        first.trace_in<Query::closest>(body.scene, *scratch);
        std::vector<char> is_inside(batch), is_used(batch);
        for (std::uint32_t i = 0; i < batch; i += W) {
            const Int<F> slot = load_int<F>(first.rays.slot + i);
            const Mask<F> found = slot > Int<F>(-1);
            for (std::uint32_t lane = 0; lane < W; ++lane) next.set(i + lane, {9, 9, 9}, {1, 1, 1});
            if (none(found)) continue;
            const Surface<F> s = surface_at<F>(body.scene, load<F>(first.rays.org, i), load<F>(first.rays.dir, i),
                                               load<F>(first.rays.t + i), slot, found);
            alignas(64) S p[3][W], normal[3][W];
            S* const p_rows[3] = {p[0], p[1], p[2]};
            S* const n_rows[3] = {normal[0], normal[1], normal[2]};
            store<F>(p_rows, 0, s.point + s.normal * s.offset);
            store<F>(n_rows, 0, s.normal);
            for (std::uint32_t lane = 0; lane < W; ++lane) {
                if (first.slot[i + lane] < 0) continue;
                is_used[i + lane] = 1;
                is_inside[i + lane] = (bits(s.inside) >> lane & 1u) != 0;
                const glm::dvec3 up(normal[0][lane], normal[1][lane], normal[2][lane]);
                // the side it came from, by the ray's own origin moved up to the hit
                const glm::dvec3 q =
                    first.org(i + lane) + first.dir(i + lane) * (static_cast<double>(first.rays.t[i + lane]) - 1e-4);
                const glm::dvec3 at = body.object_from_world * (q - body.translation);
                const double radius = 1 + body.taper * at.y, distance = std::hypot(at.x, at.z);
                if (std::fabs(distance - radius) > 1e-5) wrong_side += (distance < radius) != (is_inside[i + lane] != 0);
                const glm::dvec3 side = glm::normalize(glm::cross(up, direction(random)));
                const double cosine = random.chance(0.7) ? random.uniform(0.01, 1) : random.magnitude(1e-4, 1e-1);
                const glm::dvec3 d = up * cosine + side * std::sqrt(1 - cosine * cosine);
                for (int axis = 0; axis < 3; ++axis) {
                    next.rays.org[axis][i + lane] = p[axis][lane];
                    next.rays.dir[axis][i + lane] = static_cast<S>(d[axis]);
                }
                next.source[i + lane] =
                    is_inside[i + lane] ? source_inward(first.slot[i + lane]) : source_outward(first.slot[i + lane]);
            }
        }
        next.trace_in<Query::closest>(body.scene, *scratch);
        for (std::uint32_t i = 0; i < batch; ++i) {
            if (!is_used[i]) continue;
            if (!is_inside[i]) { // a convex body's outside: nothing of it lies ahead
                ++outside;
                wrong += next.slot[i] >= 0;
                continue;
            }
            bool doubtful = false;
            const std::vector<double> truth = body.side_hits(next.org(i), next.dir(i), 1e-4, doubtful);
            if (doubtful) continue;
            ++inside;
            met += !truth.empty();
            wrong += truth.empty() != (next.slot[i] < 0);
            if (!truth.empty() && next.slot[i] >= 0)
                wrong += std::fabs(static_cast<double>(next.rays.t[i]) - truth.back()) > 1e-3 * (1 + truth.back());
        }
    }
    CHECK(wrong == 0);
    CHECK(wrong_side == 0);
    CHECK(outside > 1000u / fewer);
    CHECK(inside > 1000u / fewer);
    CHECK(met > inside / 4);
    CHECK(met < inside);
}

TEST_CASE("closed cones: no ray leaks between cap and side, at the tip or anywhere else") {
    Lottery random(9);
    const FlushDenormals flush;
    const auto scratch = std::make_unique<TraceScratch<F>>();
    std::uint64_t leaks = 0, not_finite = 0, hits = 0;
    for (int n = 0; n < cases(300); ++n) {
        const Lone body(random_body(random, true));
        const glm::dmat3 world_from_object = glm::inverse(body.object_from_world);
        const auto at = [&](double y, double angle, double share) {
            const double r = (1 + body.taper * y) * share;
            return world_from_object * glm::dvec3(r * std::cos(angle), y, r * std::sin(angle)) + body.translation;
        };
        Batch rays;
        for (std::uint32_t i = 0; i < batch; ++i) { // from within to the rims and the tip
            const glm::dvec3 o = at(random.uniform(-0.4, 0.4), random.uniform(0, 6.3), random.uniform(0, 0.9));
            rays.set(i, o, at(random.chance(0.5) ? 0.5 : -0.5, random.uniform(0, 6.3), random.chance(0.8) ? 1 : 0) - o);
        }
        for (int round = 0; round < 2; ++round) {
            rays.trace_in<Query::closest>(body.scene, *scratch);
            for (std::uint32_t i = 0; i < batch; i += W) {
                const Int<F> slot = load_int<F>(rays.rays.slot + i);
                const Mask<F> found = slot > Int<F>(-1);
                leaks += W - static_cast<std::uint64_t>(std::popcount(bits(found)));
                if (none(found)) continue;
                const Surface<F> s = surface_at<F>(body.scene, load<F>(rays.rays.org, i), load<F>(rays.rays.dir, i),
                                                   load<F>(rays.rays.t + i), slot, found);
                const F sum = s.point.x + s.point.y + s.point.z + s.offset;
                const F one = dot(s.normal, s.normal);
                not_finite += static_cast<std::uint64_t>(
                    std::popcount(bits(found & !((abs(sum) < F(S(1e6))) & (abs(one - F(1)) < F(S(1e-5)))))));
                hits += static_cast<std::uint64_t>(std::popcount(bits(found)));
            }
            for (std::uint32_t i = 0; i < batch; ++i) { // from outside to just within the rims, and down the axis on to the tip
                const double y = random.chance(0.5) ? 0.5 : -0.5;
                glm::dvec3 p = at(y * (1 - 1e-4), random.uniform(0, 6.3), 1 - 1e-4),
                           o = body.translation + direction(random) * 9.0;
                if (i % 4 == 0 || 1 + body.taper * y < 1e-2)
                    p = body.translation, o = world_from_object * glm::dvec3(0, y * 7, 0) + p;
                rays.set(i, o, p - o);
            }
        }
    }
    CHECK(leaks == 0);
    CHECK(not_finite == 0);
    CHECK(hits > 0);
}
