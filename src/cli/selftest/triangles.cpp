// N12: the distance of triangles against the oracle, and whether it lies within their depth.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/oracle.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {
namespace {

/// 64 triangles about the origin; `stretch` times longer than wide.
SceneArrays triangles_of(double stretch, const Setting& s, Random& random) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const glm::dvec3 middle = random.point(1), along = random.direction();
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(middle + random.point(0.5 / stretch) +
                                     along * (stretch > 1 ? random.uniform(-0.5, 0.5) : 0));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    SceneDescription description;
    std::vector<Transformation> transformations = random_placing(s.placing, random);
    if (s.placing == Placing::translated) transformations = {Translation{random.direction() * random.magnitude(1, 1e8)}};
    add_object(description, mesh, transformations);
    return with_leaves_of(flatten(description, RenderSettings{}, 1), s.leaf_size);
}

void score_triangles(const Block& block, double stretch, Tally& tally) {
    Random random(block.seed);
    const SceneArrays scene = triangles_of(stretch, block.setting, random);
    Rays rays;
    glm::dvec3 from(0);
    const auto count = static_cast<int>(scene.first_slot[1]);
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        if (i % 64 == 0) from = random.direction() * random.magnitude(2, 20);
        const auto slot = static_cast<std::uint32_t>(random.below(count));
        double u = random.uniform(0, 1), v = random.uniform(0, 1);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::dvec3 a = corner(scene, slot, 0), b = corner(scene, slot, 1), c = corner(scene, slot, 2);
        rays.add(from, a + (b - a) * u + (c - a) * v - from);
    }
    if (block.setting.path == Path::mixed) shuffle(rays, random.bits());
    const Hits hits = ask(*block.setting.kernels, view(scene), rays, block.setting.path);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits.slot[i] < 0) continue; // beside a needle, by rounding: N1 has the misses that count
        const auto slot = static_cast<std::uint32_t>(hits.slot[i]);
        const glm::dvec3 o = rays.o(i), d = rays.d(i);
        const int axis = std::fabs(d.z) > std::max(std::fabs(d.x), std::fabs(d.y)) ? 2 : std::fabs(d.y) > std::fabs(d.x) ? 1 : 0;
        double lo = 1e300, hi = -1e300;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double depth = (corner(scene, slot, k)[axis] - o[axis]) / d[axis];
            lo = std::min(lo, depth), hi = std::max(hi, depth);
        }
        const double t = hits.t[i], slack = 8 * 0x1p-24 * std::max(std::fabs(lo), std::fabs(hi)); // of the weighted sum
        if (!(t >= lo - slack && t <= hi + slack)) tally.fail("ray " + std::to_string(i) + ": t outside the triangle's depth");
        const RealTriangle exact = cross_plane_of(real(corner(scene, slot, 0)), real(corner(scene, slot, 1)),
                                                  real(corner(scene, slot, 2)), real(o), real(d));
        ++tally.rays;
        if (exact.cosine < 0.1L) continue; // grazing: a matter of conditioning
        tally.add_error(ulps(hits.t[i], static_cast<double>(exact.t)));
    }
}

} // namespace

void test_triangle_t(const Block& block, Tally& tally) { score_triangles(block, 1, tally); }
void test_needle_t(const Block& block, Tally& tally) { score_triangles(block, 1e4, tally); }

} // namespace lanecast::selftest
