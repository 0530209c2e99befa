// N10, N11: spheres and cylinders against the oracle.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/oracle.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanecast::selftest {
namespace {

SceneArrays one_object(const Shape& shape, Placing placing, Random& random) {
    SceneDescription description;
    std::vector<Transformation> transformations = random_placing(placing, random);
    if (placing == Placing::translated) { // by itself: a marker would make it a body of few steps of the grid
        transformations = {Translation{random.direction() * random.magnitude(1, 1e8)}};
    }
    add_object(description, shape, transformations);
    return flatten(description, RenderSettings{}, 1);
}

struct Ball {
    glm::dvec3 centre;
    double radius;
};
Ball ball_of(const SceneArrays& scene) {
    const SphereRecord& s = scene.spheres.at(0);
    return {{s.centre[0], s.centre[1], s.centre[2]}, s.radius};
}

Hits trace(const Block& block, const SceneArrays& scene, Rays& rays, Random& random) {
    if (block.setting.path == Path::mixed) shuffle(rays, random.bits());
    return ask(*block.setting.kernels, view(scene), rays, block.setting.path);
}

/// From 3 to 1e7 radii away; at the body, and at its silhouette.
Rays far_rays(const Ball& ball, std::uint64_t count, Random& random) {
    Rays rays;
    glm::dvec3 from(0);
    for (std::uint64_t i = 0; i < count; ++i) {
        if (i % 256 == 0) from = ball.centre + random.direction() * ball.radius * random.magnitude(3, 1e7);
        double s = random.uniform(0, 1.05);
        if (random.chance(0.5)) s = 1 + random.uniform(-1e-4, 1e-4);
        const glm::dvec3 towards = glm::normalize(ball.centre - from), side = random.direction();
        const glm::dvec3 across = glm::normalize(side - towards * glm::dot(side, towards));
        const glm::dvec3 d = ball.centre + across * (s * ball.radius) - from;
        rays.add(from, random.chance(0.5) ? d : glm::normalize(d));
    }
    return rays;
}

enum class Judge { misses, false_hits, beyond_rounding };

/// Within an ulp of the radius of the silhouette either answer is right. Beyond rounding: so it is where moving the origin by two
/// of its roundings changes the answer.
void score_far(const Block& block, Judge judge, Tally& tally) {
    Random random(block.seed);
    const SceneArrays scene = one_object(Sphere{random.uniform(0.5, 2), {0, 0, 0}}, block.setting.placing, random);
    const Ball ball = ball_of(scene);
    Rays rays = far_rays(ball, block.rays, random);
    const Hits hits = trace(block, scene, rays, random);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RealVec o = real(rays.o(i)), f = o - real(ball.centre);
        const RealCrossing exact = cross_ball(f, real(rays.d(i)), Real(ball.radius));
        const bool met = hits.slot[i] >= 0;
        Real slack = 0x1p-23L;
        if (judge == Judge::beyond_rounding) slack += 2 * 0x1p-24L * length(o) / Real(ball.radius);
        const auto gap = static_cast<double>(exact.gap);
        if (met != exact.hit && std::fabs(exact.gap) > slack && (judge != Judge::misses || exact.hit) &&
            (judge != Judge::false_hits || met))
            tally.fail((met ? "hit though beside by " : "missed though within by ") + std::to_string(std::fabs(gap) * 1e9) +
                       "e-9 radii, from " + std::to_string(static_cast<double>(length(f)) / ball.radius) + " radii away");
        // at the silhouette the root itself is ill-conditioned: what is off there is off along the surface
        if (met && exact.hit && judge == Judge::misses)
            tally.add_error(ulps(hits.t[i], static_cast<double>(exact.t0)) * static_cast<double>(exact.cosine));
    }
    tally.rays += rays.size();
}

} // namespace

void test_far_sphere(const Block& block, Tally& tally) { score_far(block, Judge::misses, tally); }
void test_far_sphere_beside(const Block& block, Tally& tally) { score_far(block, Judge::false_hits, tally); }
void test_far_sphere_rounding(const Block& block, Tally& tally) { score_far(block, Judge::beyond_rounding, tally); }

void test_huge_sphere(const Block& block, Tally& tally) {
    Random random(block.seed);
    const SceneArrays scene = one_object(Sphere{random.uniform(0.5, 2), {0, 0, 0}}, block.setting.placing, random);
    const Ball ball = ball_of(scene);
    const double step = ball.radius / random.magnitude(1e2, 1e7); // what the height is counted in
    Rays rays;
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        const glm::dvec3 up = random.direction(), away = random.direction();
        const glm::dvec3 o = ball.centre + up * (ball.radius + step * random.uniform(0.5, 1.5));
        rays.add(o, (away - 1.2 * up) * (random.chance(0.5) ? 1 : step));
    }
    const Hits hits = trace(block, scene, rays, random);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RealVec o = real(rays.o(i)) - real(ball.centre), d = real(rays.d(i));
        const RealCrossing exact = cross_ball(o, d, Real(ball.radius));
        const bool met = hits.slot[i] >= 0;
        const bool ahead = exact.hit && exact.t1 > 0;
        // rounding may have put the origin on the surface: then either side is right
        const Real depth = std::fabs(length(o) - Real(ball.radius));
        const bool on_surface = depth <= 0x1p-23L * Real(ball.radius);
        if (on_surface) continue;
        ++tally.rays;
        if (met != ahead) {
            if (std::fabs(exact.gap) > 0x1p-22L) tally.fail("ray " + std::to_string(i) + (met ? ": hit" : ": missed"));
            continue;
        }
        if (!met) continue;
        const double root = static_cast<double>(exact.t0 > 0 ? exact.t0 : exact.t1);
        tally.add_error(ulps(hits.t[i], root));
    }
}

namespace {

glm::dvec3 on_cylinder(const AffineShadingRecord& forward, const AffineRecord& record, Random& random) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const bool side = random.chance(0.5);
    const double s = side ? 1 : std::sqrt(random.uniform(0, 1));
    const glm::dvec3 p(s * std::cos(angle),
                       side                 ? random.uniform(-0.5, 0.5)
                       : random.chance(0.5) ? 0.5
                                            : -0.5,
                       s * std::sin(angle));
    glm::dvec3 q(record.translation[0], record.translation[1], record.translation[2]);
    for (int row = 0; row < 3; ++row)
        for (int c = 0; c < 3; ++c) q[row] += double{forward.world_from_object[3 * row + c]} * p[c];
    return q;
}

/// Hits and t of rays at one cylinder. Left out: rays for which ends of body and caps are within 4 ulp of t, at the rim, and
/// those along the silhouette; with `rounding`: to within four roundings of the ray's origin as the body sees it.
void score_cylinder(const Block& block, const SceneArrays& scene, Rays& rays, bool rounding, Random& random, Tally& tally) {
    const AffineRecord& record = scene.affines.at(0);
    const Hits hits = trace(block, scene, rays, random);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RealVec o = to_object(record, real(rays.o(i))), d = to_object_direction(record, real(rays.d(i)));
        const RealCylinder exact = cross_body(o, d);
        const Real largest = std::max(std::fabs(exact.t0), std::fabs(exact.t1));
        if (exact.band <= 4 * 0x1p-23L * largest || std::fabs(exact.gap) < 0x1p-21L) continue;
        if (rounding) {
            const Real across = std::sqrt(o.x * o.x + o.z * o.z), slack = 4 * 0x1p-24L * across;
            const Real slope = std::sqrt(d.x * d.x + d.z * d.z);
            if (std::fabs(exact.gap) < slack) continue;
            // an end of the body moves by so much t; ends of the caps likewise
            const Real end = slope > 0 ? slack / (slope * std::sqrt(std::max(exact.gap, slack))) : 0;
            const Real cap = d.y != 0 ? 4 * 0x1p-24L * (std::fabs(o.y) + 0.5L) / std::fabs(d.y) : 0;
            if (exact.band <= end + cap) continue;
        }
        ++tally.rays;
        const bool ahead = exact.hit && exact.t1 > 0, met = hits.slot[i] >= 0;
        if (met != ahead) {
            tally.fail("ray " + std::to_string(i) + (met ? ": hit" : ": missed"));
            continue;
        }
        if (!met) continue;
        const bool enters = exact.t0 > 0;
        tally.add_error(ulps(hits.t[i], static_cast<double>(enters ? exact.t0 : exact.t1)) *
                        (enters ? static_cast<double>(exact.cosine) : 1));
    }
}

void aim_at_cylinder(const Block& block, bool rounding, Tally& tally) {
    Random random(block.seed);
    const double ratio = random.magnitude(1e-3, 1e3);
    const SceneArrays scene = one_object(Cylinder{ratio, 1, true}, block.setting.placing, random);
    Rays rays;
    glm::dvec3 from(0);
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        if (i % 256 == 0) from = random.direction() * random.magnitude(3, 10);
        rays.add(from, on_cylinder(scene.affine_shading.at(0), scene.affines.at(0), random) - from);
    }
    score_cylinder(block, scene, rays, rounding, random, tally);
}

} // namespace

void test_cylinder(const Block& block, Tally& tally) { aim_at_cylinder(block, false, tally); }
void test_cylinder_rounding(const Block& block, Tally& tally) { aim_at_cylinder(block, true, tally); }

void test_cylinder_axis(const Block& block, Tally& tally) {
    Random random(block.seed);
    const double ratio = random.magnitude(0.1, 10);
    const SceneArrays scene = one_object(Cylinder{ratio, 1, true}, block.setting.placing, random);
    const AffineRecord& record = scene.affines.at(0);
    const AffineShadingRecord& forward = scene.affine_shading.at(0);
    const auto column = [&](int c) {
        return glm::dvec3(forward.world_from_object[c], forward.world_from_object[3 + c], forward.world_from_object[6 + c]);
    };
    const glm::dvec3 centre(record.translation[0], record.translation[1], record.translation[2]);
    const double tilt = random.chance(0.3) ? 0 : random.magnitude(1e-12, 0.1);
    Rays rays;
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        const glm::dvec3 beside = column(0) * random.uniform(-1.5, 1.5) + column(2) * random.uniform(-1.5, 1.5);
        const double y = random.chance(0.5) ? random.uniform(1, 9) : random.uniform(-0.4, 0.4);
        const glm::dvec3 lean = column(0) * random.uniform(-tilt, tilt) + column(2) * random.uniform(-tilt, tilt);
        rays.add(centre + beside + column(1) * y, (random.chance(0.5) ? -2.0 : 2.0) * column(1) + lean);
    }
    score_cylinder(block, scene, rays, false, random, tally);
}

} // namespace lanecast::selftest
