// Spheres, ellipsoids, cylinders and planes against long double: t in ulp, false misses, far away and close by (numerics N10,
// N11).

#include "kernels/kernel_support.hpp"
#include "kernels/object_support.hpp"
#include "render/kernels/plane.hpp"
#include "render/kernels/quadric.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr int W = width<F>;
using Real = long double;
/// The reference's t is looked at as a float.
constexpr double slack = 1;

struct RayLanes {
    alignas(64) S org[3][W], dir[3][W];
    [[nodiscard]] Vec3<F> origin() const { return {load<F>(org[0]), load<F>(org[1]), load<F>(org[2])}; }
    [[nodiscard]] Vec3<F> direction() const { return {load<F>(dir[0]), load<F>(dir[1]), load<F>(dir[2])}; }
    void set(int lane, const std::array<double, 3>& o, const std::array<double, 3>& target) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            org[axis][lane] = static_cast<S>(static_cast<float>(o[axis]));
            dir[axis][lane] = static_cast<S>(static_cast<float>(target[axis] - static_cast<double>(org[axis][lane])));
        }
    }
    [[nodiscard]] Real o(int axis, int lane) const { return static_cast<Real>(org[axis][lane]); }
    [[nodiscard]] Real d(int axis, int lane) const { return static_cast<Real>(dir[axis][lane]); }
};

/// Both roots of |o + t d - c| = r in the plane or in space; false: none.
bool sphere_roots(const Real (&f)[3], const Real (&d)[3], Real r, Real& t0, Real& t1, Real& gap) {
    const Real dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], fd = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
    const Real tc = -fd / dd;
    const Real l[3] = {f[0] + tc * d[0], f[1] + tc * d[1], f[2] + tc * d[2]};
    const Real length = std::sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    gap = (r - length) / r;
    if (gap < 0) return false;
    const Real h = std::sqrt((r - length) * (r + length) / dd);
    const Real c = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - r * r;
    const Real far = tc >= 0 ? tc + h : tc - h, near = c / (dd * far);
    t0 = std::min(near, far), t1 = std::max(near, far);
    return true;
}

double ulp_error(S t, Real exact) { return ulps(static_cast<float>(t), static_cast<double>(exact)); }

struct Score {
    std::uint64_t rays = 0, false_miss = 0, false_hit = 0;
    std::vector<double> errors;
    double percentile(double p) {
        std::sort(errors.begin(), errors.end());
        return errors.empty() ? 0 : errors[static_cast<std::size_t>(p * static_cast<double>(errors.size() - 1))];
    }
};

/// `aim(random, lane)` gives origin and target relative to the centre.
template <class Aim>
Score score_sphere(double r, int rays, std::uint64_t seed, bool nearest_positive, Aim&& aim) {
    Lottery random(seed);
    Score score;
    const auto radius = static_cast<S>(static_cast<float>(r));
    for (int n = 0; n < rays; n += W) {
        RayLanes ray;
        for (int lane = 0; lane < W; ++lane) {
            std::array<double, 3> o, target;
            aim(random, o, target);
            ray.set(lane, o, target);
        }
        const Crossing<F> crossing =
            cross_sphere(ray.origin(), Vec3<F>{F(0), F(0), F(0)}, ray.direction(), F(radius), Mask<F>(true));
        alignas(64) S t0[W], t1[W];
        lanecast::store(t0, crossing.t0);
        lanecast::store(t1, crossing.t1);
        for (int lane = 0; lane < W; ++lane) {
            ++score.rays;
            const Real f[3] = {ray.o(0, lane), ray.o(1, lane), ray.o(2, lane)},
                       d[3] = {ray.d(0, lane), ray.d(1, lane), ray.d(2, lane)};
            Real e0 = 0, e1 = 0, gap = 0;
            const bool is_hit = sphere_roots(f, d, static_cast<Real>(radius), e0, e1, gap);
            const bool says_hit = (bits(crossing.hit) >> lane & 1u) != 0;
            // within an ulp or two of the silhouette either answer is right
            if (is_hit && !says_hit) score.false_miss += gap > 0x1p-22L;
            if (!is_hit && says_hit) score.false_hit += gap < -0x1p-22L;
            if (!is_hit || !says_hit || gap < 0.05L) continue; // at the silhouette t is ill-conditioned
            CHECK(t0[lane] <= t1[lane]);
            if (nearest_positive && e0 <= 0)
                score.errors.push_back(ulp_error(t1[lane], e1));
            else
                score.errors.push_back(ulp_error(t0[lane], e0));
        }
    }
    return score;
}

} // namespace

TEST_CASE("sphere: t within 4 ulp and no false miss from 3 to 1e7 radii away") {
    const FlushDenormals flush;
    for (const double distance : {3.0, 100.0, 1e3, 1e5, 1e7}) {
        CAPTURE(distance);
        Score score = score_sphere(1, cases(400000), 1, false, [&](Lottery& random, auto& o, auto& target) {
            const auto from = random.direction(), at = random.direction();
            const double s = random.chance(0.5) ? random.uniform(0, 1.05) : 1 + random.uniform(-1e-4, 1e-4); // and the silhouette
            for (std::size_t axis = 0; axis < 3; ++axis) o[axis] = from[axis] * distance, target[axis] = at[axis] * s;
        });
        CHECK(score.false_miss == 0);
        CHECK(static_cast<double>(score.false_hit) <= 1e-5 * static_cast<double>(score.rays));
        CHECK(score.percentile(0.99) <= 2);
        CHECK(score.percentile(1) <= 4);
        CHECK(score.errors.size() > score.rays / 10);
    }
}

TEST_CASE("sphere: within 128 ulp of t from a height of 1 over radii to 1e7") {
    const FlushDenormals flush;
    for (const double r : {1e2, 1e4, 1e7}) {
        CAPTURE(r);
        Score score = score_sphere(r, cases(200000), 2, true, [&](Lottery& random, auto& o, auto& target) {
            const auto up = random.direction(), away = random.direction();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                o[axis] = up[axis] * (r + random.uniform(0.5, 1.5));
                target[axis] = o[axis] + away[axis] - 1.2 * up[axis];
            }
        });
        CHECK(score.percentile(0.5) <= 2);
        CHECK(score.percentile(0.99) <= 32);
        CHECK(score.percentile(1) <= 128);
    }
}

TEST_CASE("sphere: a ray from the inside has one root on each side") {
    const FlushDenormals flush;
    Score score = score_sphere(1, cases(200000), 3, true, [](Lottery& random, auto& o, auto& target) {
        const auto a = random.direction(), b = random.direction();
        const double s = random.uniform(0, 0.99);
        for (std::size_t axis = 0; axis < 3; ++axis) o[axis] = a[axis] * s, target[axis] = o[axis] + b[axis];
    });
    CHECK(score.false_miss == 0);
    CHECK(score.errors.size() > score.rays * 95 / 100);
    CHECK(score.percentile(0.99) <= 8);
}

namespace {

/// The body of radius R and half height h as the unit cylinder: rays are scaled per axis, which rounds; truth is of the scaled
/// ray.
struct CylinderScore {
    std::uint64_t rays = 0, hits = 0, false_miss = 0, false_hit = 0, wrong_end = 0;
    std::vector<double> errors;
    double percentile(double p) {
        std::sort(errors.begin(), errors.end());
        return errors.empty() ? 0 : errors[static_cast<std::size_t>(p * static_cast<double>(errors.size() - 1))];
    }
};

template <class Aim>
CylinderScore score_cylinder(double radius, double height, int rays, std::uint64_t seed, Aim&& aim) {
    Lottery random(seed);
    CylinderScore score;
    const AffineRecord record = own_space();
    for (int n = 0; n < rays; n += W) {
        RayLanes ray;
        for (int lane = 0; lane < W; ++lane) {
            std::array<double, 3> o, target;
            aim(random, o, target);
            o[0] /= radius, o[2] /= radius, o[1] /= height;
            target[0] /= radius, target[2] /= radius, target[1] /= height;
            ray.set(lane, o, target);
        }
        const Vec3<F> org = ray.origin(), dir = ray.direction();
        const CappedCrossing<F> crossing = cross_cylinder(ObjectRay<F>(record, org, dir), Mask<F>(true));
        alignas(64) S t0[W];
        lanecast::store(t0, crossing.ends.t0);
        for (int lane = 0; lane < W; ++lane) {
            ++score.rays;
            const Real f[3] = {ray.o(0, lane), 0, ray.o(2, lane)}, d[3] = {ray.d(0, lane), 0, ray.d(2, lane)};
            const Real oy = ray.o(1, lane), dy = ray.d(1, lane), infinity = std::numeric_limits<Real>::infinity();
            Real b0 = -infinity, b1 = infinity, gap = 1;
            bool is_hit = d[0] != 0 || d[2] != 0 ? sphere_roots(f, d, 1, b0, b1, gap) : f[0] * f[0] + f[2] * f[2] <= 1;
            Real c0 = (-0.5L - oy) / dy, c1 = (0.5L - oy) / dy;
            if (c0 > c1) std::swap(c0, c1);
            if (dy == 0) c0 = -infinity, c1 = infinity, is_hit &= std::fabs(oy) <= 0.5L;
            const Real e0 = std::max(b0, c0), e1 = std::min(b1, c1);
            is_hit &= e0 <= e1;
            // the rim, where body and cap meet within some ulp of t, and the silhouette, where the body's t is ill-conditioned
            const Real largest = std::max(std::fabs(e0), std::fabs(e1));
            Real band = 4 * 0x1p-23L * largest;
            if (std::isfinite(b0)) band += 0x1p-21L / std::sqrt(std::max(gap, 0x1p-22L)) / std::sqrt(d[0] * d[0] + d[2] * d[2]);
            const auto near = [&](Real x, Real y) { return std::fabs(x - y) < band; };
            if (near(b0, c0) || near(b0, c1) || near(b1, c0) || near(b1, c1) || std::fabs(gap) < 0x1p-21L) continue;
            const bool says_hit = (bits(crossing.ends.hit) >> lane & 1u) != 0;
            score.false_miss += is_hit && !says_hit;
            score.false_hit += !is_hit && says_hit;
            if (!is_hit || !says_hit) continue;
            ++score.hits;
            score.wrong_end += ((bits(crossing.cap0) >> lane & 1u) != 0) != (c0 > b0);
            if (gap > 1e-3L && e0 > 0) score.errors.push_back(ulp_error(t0[lane], e0));
        }
    }
    return score;
}

void on_surface(Lottery& random, double radius, double height, std::array<double, 3>& p) {
    const double angle = random.uniform(0, 6.2831853), s = random.chance(0.5) ? 1 : std::sqrt(random.uniform(0, 1));
    p = {radius * s * std::cos(angle), s < 1 ? (random.chance(0.5) ? 0.5 : -0.5) * height : random.uniform(-0.5, 0.5) * height,
         radius * s * std::sin(angle)};
}

} // namespace

TEST_CASE("cylinder: no false miss outside the rim band, t within a few ulp") {
    const FlushDenormals flush;
    struct Shape {
        double radius, height, distance;
    };
    for (const Shape s :
         {Shape{1, 1, 5}, Shape{1, 1, 100}, Shape{1, 1, 1e4}, Shape{1e-3, 2, 5}, Shape{1, 1e-3, 5}, Shape{30, 1, 100}}) {
        INFO("radius ", s.radius, ", height ", s.height, ", distance ", s.distance);
        CylinderScore score = score_cylinder(s.radius, s.height, cases(300000), 4, [&](Lottery& random, auto& o, auto& target) {
            const auto from = random.direction();
            for (std::size_t axis = 0; axis < 3; ++axis) o[axis] = from[axis] * s.distance;
            on_surface(random, s.radius, s.height, target);
        });
        CHECK(score.false_miss == 0);
        CHECK(score.false_hit == 0);
        CHECK(score.wrong_end == 0);
        CHECK(score.hits > score.rays / 3);
        CHECK(score.percentile(0.99) <= 4);
    }
}

TEST_CASE("cylinder: along its axis the caps are hit, and nothing beside them") {
    const FlushDenormals flush;
    for (const double tilt : {0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
        CAPTURE(tilt);
        CylinderScore score = score_cylinder(1, 1, cases(200000), 5, [&](Lottery& random, auto& o, auto& target) {
            const double x = random.uniform(-1.5, 1.5), z = random.uniform(-1.5, 1.5);
            const double y = random.chance(0.5) ? random.uniform(1, 9) : random.uniform(-0.4, 0.4);
            o = {x, y, z};
            target = {x + tilt * random.uniform(-1, 1), random.chance(0.5) ? -2.0 : 2.0, z + tilt * random.uniform(-1, 1)};
        });
        CHECK(score.false_miss == 0);
        CHECK(score.false_hit == 0);
        CHECK(score.wrong_end == 0);
        CHECK(score.hits > score.rays / 10);
        CHECK(score.percentile(0.99) <= 4);
    }
}

TEST_CASE("cylinder: level rays, and rays from inside") {
    const FlushDenormals flush;
    CylinderScore level = score_cylinder(1, 1, cases(200000), 6, [](Lottery& random, auto& o, auto& target) {
        const double y = random.uniform(-0.7, 0.7);
        o = {random.uniform(-3, 3), y, random.uniform(-3, 3)};
        target = {random.uniform(-1, 1), y, random.uniform(-1, 1)};
    });
    CHECK(level.false_miss + level.false_hit == 0);
    CHECK(level.hits > level.rays / 3);
    CylinderScore inside = score_cylinder(1, 1, cases(200000), 7, [](Lottery& random, auto& o, auto& target) {
        o = {random.uniform(-0.7, 0.7), random.uniform(-0.49, 0.49), random.uniform(-0.7, 0.7)};
        const auto d = random.direction();
        target = {o[0] + d[0], o[1] + d[1], o[2] + d[2]};
    });
    CHECK(inside.false_miss + inside.false_hit == 0);
    CHECK(inside.hits == inside.rays);
}

TEST_CASE("ellipsoid: object space agrees with the world's quadratic form") {
    Lottery random(8);
    const FlushDenormals flush;
    std::vector<double> errors;
    std::uint64_t wrong = 0;
    for (int n = 0; n < cases(100000); n += W) {
        // object_from_world = diag(1 / a) * R, R a rotation from two directions
        const auto z = random.direction(), h = random.direction();
        std::array<double, 3> x{z[1] * h[2] - z[2] * h[1], z[2] * h[0] - z[0] * h[2], z[0] * h[1] - z[1] * h[0]};
        const double l = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (double& c : x) c /= l;
        const std::array<double, 3> y{z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]};
        const double axes[3] = {random.magnitude(0.1, 1), random.magnitude(0.1, 1), random.magnitude(0.1, 1)};
        AffineRecord record{};
        for (std::size_t c = 0; c < 3; ++c) {
            record.object_from_world[c] = static_cast<float>(x[c] / axes[0]);
            record.object_from_world[3 + c] = static_cast<float>(y[c] / axes[1]);
            record.object_from_world[6 + c] = static_cast<float>(z[c] / axes[2]);
            record.translation[c] = static_cast<float>(random.uniform(-1, 1) * (random.chance(0.3) ? 1e4 : 1));
        }
        RayLanes ray;
        for (int lane = 0; lane < W; ++lane) {
            const auto from = random.direction(), at = random.direction();
            std::array<double, 3> o, target;
            for (std::size_t c = 0; c < 3; ++c) {
                o[c] = static_cast<double>(record.translation[c]) + 4 * from[c];
                target[c] = static_cast<double>(record.translation[c]) + 0.1 * at[c] * random.uniform(0, 0.9);
            }
            ray.set(lane, o, target);
        }
        record.stretch = stretch_of(record);
        record.radius = 4;
        const Vec3<F> org = ray.origin(), dir = ray.direction();
        const Crossing<F> crossing = cross_ellipsoid(ObjectRay<F>(record, org, dir), Mask<F>(true));
        alignas(64) S t0[W];
        lanecast::store(t0, crossing.t0);
        for (int lane = 0; lane < W; ++lane) {
            Real a = 0, b = 0, c = -1; // |M (o - T) + t M d|^2 = 1
            for (int row = 0; row < 3; ++row) {
                Real p = 0, d = 0;
                for (int k = 0; k < 3; ++k) {
                    const auto m = static_cast<Real>(record.object_from_world[3 * row + k]);
                    p += m * (ray.o(k, lane) - static_cast<Real>(record.translation[k]));
                    d += m * ray.d(k, lane);
                }
                a += d * d, b += p * d, c += p * p;
            }
            if (b * b - a * c < 0.05L * b * b) continue; // grazing
            wrong += (bits(crossing.hit) >> lane & 1u) == 0;
            errors.push_back(ulp_error(t0[lane], (-b - std::sqrt(b * b - a * c)) / a));
        }
    }
    CHECK(wrong == 0);
    REQUIRE(!errors.empty());
    std::sort(errors.begin(), errors.end());
    MESSAGE("ellipsoid: t in ulp 99 %: ", errors[errors.size() * 99 / 100], ", worst ", errors.back());
    CHECK(errors[errors.size() * 99 / 100] <= 2);
    CHECK(errors.back() <= 4);
}

TEST_CASE("plane: t to within the conditioning of its angle, up to the horizon") {
    Lottery random(9);
    const FlushDenormals flush;
    double worst = 0;
    for (int n = 0; n < cases(400000); n += W) {
        PlaneRecord plane{};
        const auto normal = random.direction();
        for (std::size_t c = 0; c < 3; ++c) plane.normal[c] = static_cast<float>(normal[c]);
        plane.distance = static_cast<float>(random.uniform(-1, 1));
        RayLanes ray;
        for (int lane = 0; lane < W; ++lane) {
            const auto from = random.direction(), way = random.direction();
            const double steep = random.chance(0.5) ? 1 : random.magnitude(1e-6, 1); // 1e-6: the horizon
            std::array<double, 3> o, target;
            const double along = way[0] * normal[0] + way[1] * normal[1] + way[2] * normal[2];
            for (std::size_t c = 0; c < 3; ++c) o[c] = from[c], target[c] = from[c] + way[c] - normal[c] * along * (1 - steep);
            ray.set(lane, o, target);
        }
        alignas(64) S t[W];
        lanecast::store(t, plane_t(plane, ray.origin(), ray.direction()));
        for (int lane = 0; lane < W; ++lane) {
            Real height = -static_cast<Real>(plane.distance), cosine = 0, size = 0, reach = std::fabs(height);
            for (int c = 0; c < 3; ++c) {
                const auto m = static_cast<Real>(plane.normal[c]);
                height += m * ray.o(c, lane), cosine += m * ray.d(c, lane);
                size += std::fabs(m * ray.d(c, lane)), reach += std::fabs(m * ray.o(c, lane));
            }
            if (std::fabs(cosine) < 1e-6L) continue;
            const Real exact = -height / cosine;
            const Real bound = std::fabs(exact) * (3 * size / std::fabs(cosine) + 2 * reach / std::fabs(height) + 2) * 0x1p-24L;
            worst = std::max(worst, static_cast<double>(std::fabs(static_cast<Real>(t[lane]) - exact) / bound));
        }
    }
    CHECK(worst <= slack);
}
