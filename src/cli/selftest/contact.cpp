// N9: what lies four times the offset of a spawned ray above a surface is seen from it.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/random.hpp"
#include "scene/flatten.hpp"
#include "scene/transform.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {
namespace {

constexpr double gamma_7 = 4.2e-7, two_u = 1.2e-7; ///< of docs/numerics.md

Mesh sheet(double y) {
    Mesh mesh;
    mesh.positions = {{-1, y, -1}, {1, y, -1}, {1, y, 1}, {-1, y, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    return mesh;
}

/// A clear surface with an opaque one right behind it, as seen along +y, that is from below.
void make_contact(PrimitiveKind kind, double gap, Shape& clear, Shape& opaque) {
    switch (kind) {
    case PrimitiveKind::sphere:
        clear = Sphere{1, {0, 0, 0}}, opaque = Sphere{1 - gap, {0, 0, 0}};
        break;
    case PrimitiveKind::cylinder:
        clear = Cylinder{1, 2, true}, opaque = Cylinder{0.9, 2 - 2 * gap, true};
        break;
    case PrimitiveKind::plane:
        clear = Plane{{0, 0, 0}, {0, -1, 0}}, opaque = Plane{{0, gap, 0}, {0, -1, 0}};
        break;
    default:
        clear = sheet(0), opaque = sheet(gap);
    }
}

SceneDescription contact_scene(const Setting& s, double gap, const glm::dvec3& away, std::vector<Transformation> turn,
                               const glm::dvec3& look_at, const glm::dvec3& up) {
    Shape clear, opaque;
    make_contact(s.primitive, gap, clear, opaque);
    SceneDescription scene;
    const AffineTransform world = compose(turn);
    if (auto* plane = std::get_if<Plane>(&clear)) {
        auto& behind = std::get<Plane>(opaque);
        plane->normal = world.linear * plane->normal, behind.normal = plane->normal;
        plane->position = apply(world, plane->position), behind.position = apply(world, behind.position);
        turn.clear();
        add_object(scene, Sphere{1, apply(world, {0, 2, 0})}); // gives the scene a size; behind both
    }
    Material glass, white;
    glass.transmissive = glm::dvec3(1);
    white.ambient = glm::dvec3(1);
    add_object(scene, clear, turn, glass);
    add_object(scene, opaque, turn, white);
    if (s.placing == Placing::translated) add_object(scene, Sphere{0.001, -away}); // keeps the centre away; not in the picture
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    scene.camera.position = apply(world, {0, -4, 0});
    scene.camera.look_at = apply(world, look_at);
    scene.camera.up = up;
    scene.camera.field = 10;
    return scene;
}

/// Of points no farther than 1 along each axis from `place`, which counts from the centre of coordinates. docs/numerics.md:
/// gamma_7 of the magnitudes that are added up, and 2 u of the sum's, along the normal.
double offset_bound(PrimitiveKind kind, const glm::dvec3& place) {
    const double sum = std::fabs(place.x) + std::fabs(place.y) + std::fabs(place.z);
    const double body = 3; // |x| + |y| + |z| of a point of the body, turned: at most
    switch (kind) {
    case PrimitiveKind::sphere:
        return gamma_7 * std::sqrt(3.0) + two_u * (sum + sum + body);
    case PrimitiveKind::cylinder:
        return 2 * gamma_7 * body + two_u * (sum + sum + body);
    case PrimitiveKind::plane:
        return (gamma_7 + two_u) * (sum + body);
    default:
        return gamma_7 * (sum + body + 2 * body) + two_u * (sum + body);
    }
}

} // namespace

void test_contact(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        const glm::dvec3 away = random.point(s.placing == Placing::translated ? 30 : 0.3);
        const std::vector<Transformation> turn{Rotation{random.direction(), random.uniform(0, 360)}, Translation{away}};
        const glm::dvec3 look_at(random.uniform(-0.2, 0.2), 0, random.uniform(-0.2, 0.2)), up = random.direction();
        const auto make = [&](double gap) { return contact_scene(s, gap, away, turn, look_at, up); };
        SceneArrays arrays = flatten(make(0.01), RenderSettings{}, 1); // to learn where the centre of coordinates is
        const double gap = 4 * offset_bound(s.primitive, away - arrays.normalisation.centre);
        const SceneDescription scene = make(gap);
        arrays = flatten(scene, RenderSettings{}, 1);
        constexpr int edge = 64;
        const Picture picture = render(*s.kernels, arrays, scene.camera, RenderSettings{}, edge, edge);
        std::uint64_t lost = 0;
        for (const float value : picture.film.rgb[0]) lost += value == 1.0f ? 0 : 1;
        if (lost > 0) tally.fail("a gap of " + std::to_string(gap * 1e6) + "e-6 is not seen", lost);
        return std::uint64_t{edge * edge};
    });
}

} // namespace lanecast::selftest
