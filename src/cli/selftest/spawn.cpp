// N8: nothing shadows or mirrors itself that is convex. Rays start where the renderer starts them, so these are pictures.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {
namespace {

/// A convex body of the kind, its size about 1, placed with pbrt's ranges of Reintersect: scales of 1e-4 to 1e4 along each axis
/// for bodies that know themselves, 1e-4 to 1e7 for meshes; up to 1e3 sizes from the centre of the scene.
struct BodyScene {
    SceneDescription description;
    glm::dvec3 centre;
    double size;
};

Shape convex_shape(const Setting& s, Random& random) {
    // Vertices are rounded to floats: flat quads make no body that is convex to a double's offset. To a float's they must.
    const bool in_double = s.kernels->precision == Precision::precise || s.kernels->precision == Precision::reference;
    switch (s.primitive) {
    case PrimitiveKind::triangle:
        return closed_mesh(in_double ? Form::staggered_ball : Form::ball, 16);
    case PrimitiveKind::plane:
        return Plane{random.point(1), random.direction()};
    case PrimitiveKind::cone:
        return Cone{random.uniform(0.2, 1), random.chance(0.5) ? 0 : random.uniform(0.1, 1), random.uniform(0.3, 2), true};
    case PrimitiveKind::cylinder:
        return Cylinder{random.uniform(0.2, 1), random.uniform(0.3, 2), true};
    default:
        return Sphere{random.uniform(0.3, 1), {0, 0, 0}};
    }
}

BodyScene make_body(const Setting& s, Random& random) {
    BodyScene scene;
    Object object = make_object(convex_shape(s, random));
    bool alone = true;
    if (s.primitive == PrimitiveKind::ellipsoid) object.transformations.emplace_back(Scale{{1, random.uniform(0.2, 0.9), 1.3}});
    if (s.primitive != PrimitiveKind::plane) {
        const bool wild = s.placing == Placing::stretched && s.primitive != PrimitiveKind::triangle && random.chance(0.3);
        std::vector<Transformation> more = random_placing(s.placing, random);
        if (wild) more = {Scale{{random.magnitude(1e-2, 1e2), random.magnitude(1e-2, 1e2), random.magnitude(1e-2, 1e2)}}};
        if (s.placing == Placing::scaled) more = {Scale{glm::dvec3(random.magnitude(1e-4, 1e7))}};
        if (s.placing == Placing::translated) {
            alone = random.chance(0.3);
            more = {Translation{random.direction() * (alone ? random.magnitude(1, 1e8) : random.magnitude(1, 1e3))}};
        }
        object.transformations.insert(object.transformations.end(), more.begin(), more.end());
    }
    object.material.diffuse = glm::dvec3(1);
    const AffineTransform world = compose(object.transformations);
    scene.centre = world.translation;
    scene.size = 0;
    for (int axis = 0; axis < 3; ++axis) scene.size = std::max(scene.size, 1.3 * glm::length(world.linear[axis]));
    if (s.primitive == PrimitiveKind::plane) scene.centre = std::get<Plane>(object.shape).position, scene.size = 1;
    scene.description.objects.push_back(object);
    if (!alone) add_object(scene.description, Sphere{1e-9 * scene.size, -scene.centre}); // too small to stand in a light
    if (s.primitive == PrimitiveKind::plane) // gives the scene its scale; behind the plane, where no light goes
        add_object(scene.description, Sphere{1, scene.centre - 3.0 * std::get<Plane>(object.shape).normal});
    Camera& camera = scene.description.camera;
    camera.field = 40;
    glm::dvec3 from = random.direction();
    if (const auto* plane = std::get_if<Plane>(&object.shape); plane != nullptr && glm::dot(from, plane->normal) < 0)
        from = -from;
    camera.position = scene.centre + from * scene.size * random.uniform(2.2, 6);
    camera.look_at = scene.centre;
    camera.up = random.direction();
    return scene;
}

constexpr int edge = 96; ///< of the pictures, in pixels

SceneArrays flat(const BodyScene& body, const Setting& s) {
    return with_leaves_of(flatten(body.description, RenderSettings{}, 1), s.leaf_size);
}

} // namespace

/// With shadows and without them a convex body alone looks the same. Lights stand all around it, so that at every point some
/// graze the surface.
void test_self_shadow(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        BodyScene body = make_body(s, random);
        for (int i = 0; i < 16; ++i) {
            const glm::dvec3 color(1 + i, 1, 1);
            glm::dvec3 way = random.direction();
            if (const auto* plane = std::get_if<Plane>(&body.description.objects[0].shape)) {
                const double along = glm::dot(way, plane->normal);
                way += plane->normal * (random.magnitude(1e-4, 1) - along); // above it, often barely
            }
            if (i % 2 == 0)
                body.description.lights.emplace_back(DirectionalLight{color, -way, 0});
            else
                body.description.lights.emplace_back(
                    PointLight{color, body.centre + way * body.size * random.uniform(1.5, 30), {1, 0, 0}, 0});
        }
        const SceneArrays scene = flat(body, s);
        RenderSettings settings;
        const Picture with = render(*s.kernels, scene, body.description.camera, settings, edge, edge);
        settings.shadows = false;
        const Picture without = render(*s.kernels, scene, body.description.camera, settings, edge, edge);
        const std::uint64_t shadow = with.stats.kinds[static_cast<int>(RayKind::shadow)].rays;
        std::size_t first = 0;
        if (const std::uint64_t wrong = differing_pixels(with.film, without.film, first); wrong > 0)
            tally.fail("pixel " + std::to_string(first % edge) + ", " + std::to_string(first / edge) + " shadows itself", wrong);
        return std::max<std::uint64_t>(shadow, 1);
    });
}

/// A reflection off a convex mirror alone is never reflected again: a picture of two levels needs as many as one of a single one.
void test_self_reflection(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        BodyScene body = make_body(s, random);
        body.description.objects[0].material = Material{};
        body.description.objects[0].material.reflective = glm::dvec3(1);
        const SceneArrays scene = flat(body, s);
        RenderSettings settings;
        settings.depth = 2;
        const Picture picture = render(*s.kernels, scene, body.description.camera, settings, edge, edge);
        const std::uint64_t reflected = picture.stats.kinds[static_cast<int>(RayKind::reflection)].rays;
        settings.depth = 1;
        const Picture once = render(*s.kernels, scene, body.description.camera, settings, edge, edge);
        const std::uint64_t first_level = once.stats.kinds[static_cast<int>(RayKind::reflection)].rays;
        if (reflected > first_level)
            tally.fail(std::to_string(reflected - first_level) + " reflections met the mirror again", reflected - first_level);
        return std::max<std::uint64_t>(first_level, 1);
    });
}

} // namespace lanecast::selftest
