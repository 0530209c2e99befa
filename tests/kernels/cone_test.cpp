// The unit cone against long double: t, rims, tips, rays along the axis, along the side and from far away.

#include "kernels/kernel_support.hpp"
#include "kernels/object_support.hpp"
#include "render/kernels/cone.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr std::uint32_t W = width<F>;
using Real = long double;
constexpr Real infinity = std::numeric_limits<Real>::infinity();

/// The way of a ray through the unit cone, and how near it is to another answer, in units of the radius where it comes closest.
struct Truth {
    Real body0, body1, cap0, cap1;
    Real gap;  ///< to the silhouette: below 0 the side is missed
    Real apex; ///< distance to it, in mean radii
    [[nodiscard]] Real t0() const { return std::max(body0, cap0); }
    [[nodiscard]] Real t1() const { return std::min(body1, cap1); }
    [[nodiscard]] bool hit() const { return t0() <= t1(); }
};

Truth truth_of(const Real (&o)[3], const Real (&d)[3], Real taper) {
    const Real rho = 1 + taper * o[1], slope = taper * d[1];
    Truth truth{infinity, -infinity, -infinity, infinity, 1, 1};
    if (d[1] != 0) {
        truth.cap0 = (-0.5L - o[1]) / d[1], truth.cap1 = (0.5L - o[1]) / d[1];
        if (truth.cap0 > truth.cap1) std::swap(truth.cap0, truth.cap1);
    } else if (std::fabs(o[1]) > 0.5L) {
        truth.cap0 = infinity, truth.cap1 = -infinity;
    }
    const Real vv = d[0] * d[0] + d[2] * d[2] + slope * slope;
    if (vv == 0) {
        if (o[0] * o[0] + o[2] * o[2] <= rho * rho) truth.body0 = -infinity, truth.body1 = infinity;
        return truth;
    }
    const Real tm = -(o[0] * d[0] + o[2] * d[2] + rho * slope) / vv;
    const Real x = o[0] + tm * d[0], z = o[2] + tm * d[2], r = rho + tm * slope;
    const Real a = d[0] * d[0] + d[2] * d[2] - slope * slope, b = x * d[0] + z * d[2] - r * slope, c = x * x + z * z - r * r;
    const Real w = std::hypot(r * d[0] - slope * x, r * d[2] - slope * z), n = std::fabs(x * d[2] - z * d[0]);
    truth.apex = std::sqrt(x * x + z * z + r * r);
    truth.gap = (w - n) / std::max(w, n);
    if (a > 0 && truth.gap < 0) return truth;
    const Real root = std::sqrt(std::max<Real>((w - n) * (w + n), 0)), q = -(b + std::copysign(root, b));
    Real lo = tm + q / a, hi = tm + (q == 0 ? 0 : c / q);
    if (lo > hi) std::swap(lo, hi);
    if (a > 0) {
        if (rho + slope * (lo + hi) / 2 > 0) truth.body0 = lo, truth.body1 = hi;
    } else if (slope > 0) {
        truth.body0 = hi, truth.body1 = infinity;
    } else {
        truth.body0 = -infinity, truth.body1 = lo;
    }
    return truth;
}

struct Score {
    std::uint64_t rays = 0, hits = 0, false_miss = 0, false_hit = 0, wrong_end = 0, off = 0;
    std::vector<double> errors; ///< of the nearer t, in ulp
    double percentile(double p) {
        std::sort(errors.begin(), errors.end());
        return errors.empty() ? 0 : errors[static_cast<std::size_t>(p * static_cast<double>(errors.size() - 1))];
    }
};

/// `aim` gives a ray's origin and target in the cone's space, but for the rounding of its turn.
template <class Aim>
Score score_cone(const AffineRecord& record, int rays, std::uint64_t seed, Aim&& aim) {
    Lottery random(seed);
    const FlushDenormals flush;
    const auto taper = static_cast<S>(record.taper);
    const float* const turn = record.object_from_world;
    const auto to_world = [&](const glm::dvec3& p, int axis) {
        return p.x * turn[axis] + p.y * turn[3 + axis] + p.z * turn[6 + axis];
    };
    Score score;
    for (int n = 0; n < rays; n += static_cast<int>(W)) {
        alignas(64) S org[3][W], dir[3][W], t[2][W];
        for (std::uint32_t lane = 0; lane < W; ++lane) {
            glm::dvec3 o, target;
            aim(random, o, target);
            for (int axis = 0; axis < 3; ++axis) {
                org[axis][lane] = static_cast<S>(static_cast<float>(to_world(o, axis)));
                dir[axis][lane] =
                    static_cast<S>(static_cast<float>(to_world(target, axis) - static_cast<double>(org[axis][lane])));
            }
        }
        const Vec3<F> o{load<F>(org[0]), load<F>(org[1]), load<F>(org[2])}, d{load<F>(dir[0]), load<F>(dir[1]), load<F>(dir[2])};
        const CappedCrossing<F> crossing = cross_cone(ObjectRay<F>(record, o, d), Mask<F>(true));
        lanecast::store(t[0], crossing.ends.t0);
        lanecast::store(t[1], crossing.ends.t1);
        for (std::uint32_t lane = 0; lane < W; ++lane) {
            ++score.rays;
            Real oo[3], dd[3];
            for (int row = 0; row < 3; ++row) {
                oo[row] = dd[row] = 0;
                for (int axis = 0; axis < 3; ++axis) {
                    oo[row] += Real{turn[3 * row + axis]} * org[axis][lane];
                    dd[row] += Real{turn[3 * row + axis]} * dir[axis][lane];
                }
            }
            const Truth truth = truth_of(oo, dd, taper);
            const Real rho = 1 + Real{taper} * oo[1], slope = Real{taper} * dd[1];
            const Real t0 = truth.t0(), t1 = truth.t1();
            // Where side and cap meet, at the silhouette and at the tip either answer is right: bands of some ulp.
            const Real shallow = dd[0] * dd[0] + dd[2] * dd[2] - slope * slope;
            const Real length = std::sqrt(dd[0] * dd[0] + dd[2] * dd[2] + slope * slope);
            const auto close = [&](Real body, Real cap) {
                if (!std::isfinite(body) || !std::isfinite(cap)) return false;
                // t's condition: how fast the ray crosses the side there
                const Real r = rho + slope * body;
                const Real speed = std::fabs((oo[0] + body * dd[0]) * dd[0] + (oo[2] + body * dd[2]) * dd[2] - r * slope);
                return std::fabs(body - cap) < 0x1p-21L * (std::fabs(cap) + r * r / std::max(speed, 0x1p-40L));
            };
            if (close(truth.body0, truth.cap0) || close(truth.body0, truth.cap1) || close(truth.body1, truth.cap0) ||
                close(truth.body1, truth.cap1) || std::fabs(truth.gap) < 0x1p-20L * (1 + 1 / truth.apex) || truth.apex < 1e-6L ||
                std::fabs(shallow) < 0x1p-20L * length * length)
                continue;
            const bool says_hit = (bits(crossing.ends.hit) >> lane & 1u) != 0;
            score.false_miss += truth.hit() && !says_hit;
            score.false_hit += !truth.hit() && says_hit;
            if (!truth.hit() || !says_hit) continue;
            ++score.hits;
            const bool cap0 = (bits(crossing.cap0) >> lane & 1u) != 0, cap1 = (bits(crossing.cap1) >> lane & 1u) != 0;
            score.wrong_end += (cap0 != (truth.cap0 > truth.body0)) + (cap1 != (truth.cap1 < truth.body1));
            for (const int end : {0, 1}) { // what is on the side is, to a few ulp of the radius there
                if (end == 0 ? cap0 : cap1) continue;
                const Real at = t[end][lane], x = oo[0] + at * dd[0], z = oo[2] + at * dd[2], r = rho + at * slope;
                const Real step = std::sqrt(dd[0] * dd[0] + dd[2] * dd[2] + slope * slope) * std::fabs(at);
                score.off += !(std::fabs(std::hypot(x, z) - r) <= 0x1p-21L * r + 0x1p-23L * (1 + step));
            }
            if (std::fabs(truth.gap) > 1e-3L && t0 > 0)
                score.errors.push_back(ulps(static_cast<float>(t[0][lane]), static_cast<double>(t0)));
            else if (std::fabs(truth.gap) > 1e-3L && t1 > 0)
                score.errors.push_back(ulps(static_cast<float>(t[1][lane]), static_cast<double>(t1)));
        }
    }
    return score;
}

template <class Aim>
Score score_cone(double taper, int rays, std::uint64_t seed, Aim&& aim) {
    return score_cone(own_space(static_cast<float>(taper)), rays, seed, aim);
}

glm::dvec3 direction(Lottery& random) {
    const auto d = random.direction();
    return {d[0], d[1], d[2]};
}

glm::dvec3 on_cone(Lottery& random, double taper) {
    const double angle = random.uniform(0, 6.2831853),
                 y = random.chance(0.3) ? (random.chance(0.5) ? 0.5 : -0.5) : random.uniform(-0.5, 0.5);
    const double r = (1 + taper * y) * (std::fabs(y) == 0.5 ? std::sqrt(random.uniform(0, 1)) : 1);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

constexpr double tapers[] = {-2, 2, -1.7, 0.6, -0.01, 1e-6, 0};

} // namespace

TEST_CASE("cone: no false miss, the right end, t within a few ulp, from near and far") {
    for (const double taper : tapers)
        for (const double distance : {3.0, 100.0, 1e4}) {
            INFO("taper ", taper, ", distance ", distance);
            Score score = score_cone(taper, cases(60000), 1, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
                o = direction(random) * distance;
                target = on_cone(random, taper);
            });
            CHECK(score.false_miss + score.false_hit == 0);
            CHECK(score.wrong_end == 0);
            CHECK(score.off == 0);
            CHECK(score.hits > score.rays / 2);
            CHECK(score.percentile(0.99) <= 8);
        }
}

TEST_CASE("cone: rays from within, level rays, rays along the axis") {
    for (const double taper : tapers) {
        CAPTURE(taper);
        Score inside = score_cone(taper, cases(60000), 2, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
            o = on_cone(random, taper) * 0.9;
            o.x *= 0.5, o.z *= 0.5;
            target = o + direction(random);
        });
        CHECK(inside.false_miss + inside.false_hit + inside.wrong_end + inside.off == 0);
        CHECK(inside.hits > inside.rays * 9 / 10);
        Score level = score_cone(taper, cases(60000), 3, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
            const double y = random.uniform(-0.7, 0.7);
            o = {random.uniform(-3, 3), y, random.uniform(-3, 3)}, target = {random.uniform(-1, 1), y, random.uniform(-1, 1)};
        });
        CHECK(level.false_miss + level.false_hit + level.wrong_end + level.off == 0);
        CHECK(level.hits > level.rays / 8);
        for (const double tilt : {0.0, 1e-12, 1e-6, 1e-3, 0.1}) {
            CAPTURE(tilt);
            Score axis = score_cone(taper, cases(30000), 4, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
                const double x = random.uniform(-2, 2), z = random.uniform(-2, 2);
                o = {x, random.chance(0.5) ? random.uniform(1, 9) : random.uniform(-0.4, 0.4), z};
                target = {x + tilt * random.uniform(-1, 1), random.chance(0.5) ? -2 : 2, z + tilt * random.uniform(-1, 1)};
            });
            CHECK(axis.false_miss + axis.false_hit + axis.wrong_end + axis.off == 0);
            CHECK(axis.hits > axis.rays / 20);
        }
    }
}

TEST_CASE("cone: at the silhouette, parallel to the side, and close by the tip") {
    for (const double taper : {-2.0, -1.7, 0.6}) {
        CAPTURE(taper);
        Score grazing = score_cone(taper, cases(60000), 5, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
            // in the tangent plane of a point of the side, a little off it
            const double angle = random.uniform(0, 6.2831853), y = random.uniform(-0.45, 0.45), r = 1 + taper * y;
            const glm::dvec3 p(r * std::cos(angle), y, r * std::sin(angle)), across(-std::sin(angle), 0, std::cos(angle));
            const glm::dvec3 along(taper * std::cos(angle), 1, taper * std::sin(angle));
            target = p + glm::dvec3(std::cos(angle), 0, std::sin(angle)) * random.uniform(-1, 1) * random.magnitude(1e-7, 1e-2);
            o = target + (across * random.uniform(-1, 1) + along * random.uniform(-1, 1)) * random.magnitude(0.1, 100);
        });
        CHECK(grazing.false_miss + grazing.false_hit + grazing.wrong_end + grazing.off == 0);
        CHECK(grazing.hits > grazing.rays / 20);
    }
    for (const double near : {1e-1, 1e-3, 1e-5}) {
        CAPTURE(near);
        Score tip = score_cone(-2, cases(60000), 6, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
            o = direction(random) * random.uniform(2, 5);
            target = glm::dvec3(0, 0.5, 0) + direction(random) * near;
        });
        CHECK(tip.false_miss + tip.false_hit + tip.wrong_end + tip.off == 0);
        CHECK(tip.hits > tip.rays / 10);
    }
}

TEST_CASE("cone, turned: nearly level rays from far away, close by a cap or the tip") {
    Lottery turns(8);
    for (const double taper : {-2.0, -1.7, 0.6})
        for (const double distance : {3.0, 30.0, 1e3}) {
            INFO("taper ", taper, ", distance ", distance);
            const glm::dvec3 x = direction(turns), y = glm::normalize(glm::cross(x, direction(turns))), z = glm::cross(x, y);
            AffineRecord turned = own_space(static_cast<float>(taper));
            for (int axis = 0; axis < 3; ++axis) {
                turned.object_from_world[axis] = static_cast<float>(x[axis]);
                turned.object_from_world[3 + axis] = static_cast<float>(y[axis]);
                turned.object_from_world[6 + axis] = static_cast<float>(z[axis]);
            }
            turned.stretch = stretch_of(turned);
            Score score = score_cone(turned, cases(200000), 9, [&](Lottery& random, glm::dvec3& o, glm::dvec3& target) {
                const double below = random.magnitude(1e-7, 1e-1), r = 1 + taper * (0.5 - below),
                             angle = random.uniform(0, 6.2831853);
                target = glm::dvec3(0, 0.5 - below, 0) + direction(random) * random.uniform(0, r);
                o = target +
                    glm::dvec3(std::cos(angle), random.uniform(-1, 1) * random.magnitude(1e-4, 1e-1), std::sin(angle)) * distance;
            });
            CHECK(score.false_miss + score.false_hit == 0);
            CHECK(score.wrong_end == 0);
            CHECK(score.off == 0);
            CHECK(score.hits > score.rays / 4);
        }
}

// A turn by 45 degrees after another leaves a residue of 1e-17 in a matrix, by which a ray that is level for all purposes meets
// the planes of the caps 1e17 away.
TEST_CASE("cone, cylinder: rays that are level but for a residue of rounding") {
    Lottery random(9);
    const FlushDenormals flush;
    const float s = 0.70710677f;
    std::uint64_t wrong = 0, hits = 0, misses = 0;
    double worst = 0;
    for (int n = 0; n < cases(60000); ++n) {
        const float taper = random.chance(0.5) ? 0.0f : static_cast<float>(random.uniform(-1.5, 1.5));
        const auto flat = static_cast<float>(std::pow(2.0, random.uniform(0, 8)));
        const auto residue = static_cast<float>(std::pow(10.0, random.uniform(-30, -6)) * (random.chance(0.5) ? 1 : -1));
        AffineRecord record = own_space(taper);
        const float rows[9] = {s, s, 0, -s * flat, s * flat, residue, 0, 0, 1};
        std::copy(std::begin(rows), std::end(rows), record.object_from_world);
        record.stretch = stretch_of(record);
        const auto along = static_cast<S>(static_cast<float>(random.uniform(-1, 1)));
        const S dir[3] = {along, along, static_cast<S>(static_cast<float>(random.uniform(0.5, 1)))};
        const double height = random.uniform(-1, 1) / flat, back = random.uniform(-4, 4), aside = random.uniform(-1.2, 1.2);
        const S org[3] = {static_cast<S>(static_cast<float>(-height * 0.70710678 + aside * 0.70710678)),
                          static_cast<S>(static_cast<float>(height * 0.70710678 + aside * 0.70710678)),
                          static_cast<S>(static_cast<float>(back))};
        Real oo[3], dd[3];
        for (int row = 0; row < 3; ++row) {
            oo[row] = dd[row] = 0;
            for (int axis = 0; axis < 3; ++axis) {
                oo[row] += Real{record.object_from_world[3 * row + axis]} * org[axis];
                dd[row] += Real{record.object_from_world[3 * row + axis]} * dir[axis];
            }
        }
        const Truth truth = truth_of(oo, dd, taper);
        if (std::fabs(truth.gap) < 1e-4L || std::fabs(std::fabs(oo[1]) - 0.5L) < 1e-4L) continue;
        const Vec3<F> o{F(org[0]), F(org[1]), F(org[2])}, d{F(dir[0]), F(dir[1]), F(dir[2])};
        const ObjectRay<F> ray(record, o, d);
        for (const bool as_cone : {true, false}) {
            if (!as_cone && taper != 0) continue;
            const Crossing<F> ends = (as_cone ? cross_cone(ray, Mask<F>(true)) : cross_cylinder(ray, Mask<F>(true))).ends;
            const bool says_hit = any(ends.hit);
            wrong += says_hit != truth.hit();
            (truth.hit() ? hits : misses) += 1;
            if (!truth.hit() || !says_hit) continue;
            alignas(64) S t0[W];
            lanecast::store(t0, ends.t0);
            worst = std::max(worst, std::fabs(static_cast<double>(t0[0] - truth.t0())));
        }
    }
    CHECK(wrong == 0);
    CHECK(worst < 1e-4);
    CHECK(hits > misses / 10);
    CHECK(misses > hits / 10);
}
