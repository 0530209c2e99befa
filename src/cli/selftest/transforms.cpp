// N13: where a ray meets a transformed body, and the normal there, however far off the body lies.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/oracle.hpp"
#include "cli/selftest/scenes.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {
namespace {

/// A body of size about 1 whose matrix has a condition of at most 10, up to 1e6 away from the centre of the scene.
SceneArrays far_body(const Setting& s, Random& random) {
    SceneDescription scene;
    std::vector<Transformation> place{Scale{{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}},
                                      Rotation{random.direction(), random.uniform(0, 360)}};
    if (s.placing == Placing::mirrored) place.emplace_back(Scale{{-1, 1, 1}});
    if (s.placing == Placing::translated) {
        const glm::dvec3 away = random.direction() * random.magnitude(1, 1e6);
        place.emplace_back(Translation{away});
        add_object(scene, Sphere{0.01, -away});
    }
    if (s.primitive == PrimitiveKind::ellipsoid)
        add_object(scene, Sphere{1, {0, 0, 0}}, place);
    else
        add_object(scene, Cylinder{1, 1, true}, place);
    return flatten(scene, RenderSettings{}, 1);
}

struct Met {
    Real off;       ///< how far the point is off the surface, in object space
    RealVec normal; ///< in object space
};
Met meet(PrimitiveKind kind, const RealVec& q, bool cap) {
    if (kind == PrimitiveKind::ellipsoid) return {std::fabs(length(q) - 1), q};
    if (cap) return {std::fabs(std::fabs(q.y) - 0.5L), {0, q.y < 0 ? -1.0L : 1.0L, 0}};
    return {std::fabs(std::sqrt(q.x * q.x + q.z * q.z) - 1), {q.x, 0, q.z}};
}

void score_bodies(const Block& block, bool normals, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneArrays scene = far_body(s, random);
    const AffineRecord& record = scene.affines.at(0);
    const AffineShadingRecord& forward = scene.affine_shading.at(0);
    Rays rays;
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        const auto world = [&](const glm::dvec3& p) {
            glm::dvec3 q(record.translation[0], record.translation[1], record.translation[2]);
            for (int row = 0; row < 3; ++row)
                for (int c = 0; c < 3; ++c) q[row] += double{forward.world_from_object[3 * row + c]} * p[c];
            return q;
        };
        const glm::dvec3 from = world(random.direction() * random.uniform(1.5, 3));
        rays.add(from, world(random.direction() * random.uniform(0, 0.5)) - from);
    }
    std::vector<float> t(rays.size()), n[3];
    std::vector<std::int32_t> slot(rays.size());
    RayStream stream{};
    for (int axis = 0; axis < 3; ++axis) {
        n[axis].resize(rays.size());
        stream.org[axis] = rays.org[axis].data(), stream.dir[axis] = rays.dir[axis].data();
        stream.normal[axis] = n[axis].data();
    }
    stream.t = t.data(), stream.slot = slot.data();
    stream.count = static_cast<std::uint32_t>(rays.size());
    s.kernels->closest_hit(view(scene), stream);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (slot[i] < static_cast<std::int32_t>(scene.first_slot[2])) continue; // beside it, or the marker
        const RealVec o = to_object(record, real(rays.o(i))), d = to_object_direction(record, real(rays.d(i)));
        const RealCylinder ends = cross_body(o, d);
        const bool cap = s.primitive == PrimitiveKind::cylinder && (ends.t0 > 0 ? ends.cap : false);
        if (s.primitive == PrimitiveKind::cylinder && (!(ends.hit && ends.t0 > 0) || ends.band < 1e-5L)) continue; // the rim
        const Met met = meet(s.primitive, o + d * Real(t[i]), cap);
        ++tally.rays;
        if (!normals) {
            tally.add_error(static_cast<double>(met.off));
            continue;
        }
        const float* const m = record.object_from_world;
        const auto column = [&](int c) {
            return Real(m[c]) * met.normal.x + Real(m[c + 3]) * met.normal.y + Real(m[c + 6]) * met.normal.z;
        };
        const RealVec exact{column(0), column(1), column(2)}, found{Real(n[0][i]), Real(n[1][i]), Real(n[2][i])};
        tally.add_error(static_cast<double>(length(cross(exact, found)) / (length(exact) * length(found))));
    }
}

} // namespace

void test_object_space(const Block& block, Tally& tally) { score_bodies(block, false, tally); }
void test_normals(const Block& block, Tally& tally) { score_bodies(block, true, tally); }

} // namespace lanecast::selftest
