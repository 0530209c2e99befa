#include "cli/selftest/scenes.hpp"

#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"

#include <cmath>

namespace lanecast::selftest {
namespace {

Mesh random_mesh(const glm::dvec3& position, Random& random) {
    Mesh mesh;
    const int count = 1 + random.below(16);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 p = position + random.point(0.5);
        const double width = random.chance(0.3) ? random.magnitude(1e-4, 1) : 1;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(p);
        mesh.positions.push_back(p + random.point(0.7));
        mesh.positions.push_back(p + random.point(0.7 * width));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

Shape random_shape(PrimitiveKind kind, Random& random) {
    const double radius = random.uniform(0.1, 0.6), height = random.uniform(0.2, 1.5);
    const double apex = random.chance(0.5) ? 0 : random.uniform(0, 0.7);
    switch (kind) {
    case PrimitiveKind::triangle:
        return random_mesh({0, 0, 0}, random);
    case PrimitiveKind::cylinder:
        return Cylinder{radius, height, true};
    case PrimitiveKind::cone:
        return Cone{radius, apex, height, true};
    case PrimitiveKind::open_cone:
        if (random.chance(0.4)) return Cylinder{radius, height, false};
        return Cone{radius, apex, height, false};
    default:
        return Sphere{radius, {0, 0, 0}};
    }
}

glm::dvec3 point_of(const SphereRecord& sphere) { return {sphere.centre[0], sphere.centre[1], sphere.centre[2]}; }

} // namespace

Object random_object(PrimitiveKind kind, Placing placing, const glm::dvec3& position, Random& random) {
    if (kind == PrimitiveKind::plane) return make_object(Plane{position, random.direction()});
    Object object = make_object(random_shape(kind, random));
    if (kind == PrimitiveKind::ellipsoid)
        object.transformations.emplace_back(Scale{{1, random.uniform(1.1, 2), random.uniform(0.3, 0.9)}});
    // sizes stay comparable within a scene: a common scale is normalisation's business, and a translation that of all
    if (placing == Placing::scaled) {
        object.transformations.emplace_back(Scale{glm::dvec3(random.magnitude(0.03, 3))});
    } else if (placing == Placing::rotated && random.chance(0.3)) { // to these, rays along a diagonal are level but for 1e-17
        object.transformations.emplace_back(Rotation{{0, 1, 0}, random.uniform(0, 360)});
        object.transformations.emplace_back(Rotation{{0, 0, 1}, 45.0 * (1 + 2 * random.below(4))});
    } else if (placing != Placing::translated) {
        const std::vector<Transformation> more = random_placing(placing, random);
        object.transformations.insert(object.transformations.end(), more.begin(), more.end());
    }
    object.transformations.emplace_back(Translation{position});
    return object;
}

SceneDescription random_scene(PrimitiveKind kind, Placing placing, int count, Random& random) {
    SceneDescription scene;
    const int layout = random.below(4);
    const double spacing = random.chance(0.5) ? 1 : random.magnitude(0.05, 20);
    const glm::dvec3 line = random.direction(), where = random.point(1);
    const glm::dvec3 away = placing == Placing::translated ? random.direction() * random.magnitude(1, 1e4) : glm::dvec3(0);
    for (int i = 0; i < count; ++i) {
        glm::dvec3 position = random.point(spacing * 3);
        if (layout == 1) position = line * (spacing * i);
        if (layout == 2) position = spacing * glm::dvec3(i % 4, i / 4 % 4, i / 16);
        if (layout == 3 && i % 2 == 0) position = where;
        const bool other = random.chance(0.33) || (kind == PrimitiveKind::plane && i > 3);
        const auto of = other ? static_cast<PrimitiveKind>(random.below(6)) : kind;
        scene.objects.push_back(random_object(of, placing, position + away, random));
    }
    if (placing == Placing::translated && random.chance(0.5)) // else it is the scene's own centre
        scene.objects.push_back(random_object(PrimitiveKind::sphere, Placing::plain, -away, random));
    return scene;
}

glm::dvec3 random_target(const SceneArrays& scene, Random& random) {
    const std::uint32_t bounded = scene.first_slot[6];
    if (bounded == 0 || random.chance(0.2)) return random.point(1);
    const auto slot = static_cast<std::uint32_t>(random.below(static_cast<int>(bounded)));
    if (slot < scene.first_slot[1]) {
        const glm::dvec3 a = corner(scene, slot, 0), b = corner(scene, slot, 1), c = corner(scene, slot, 2);
        if (random.chance(0.3)) return a;
        const glm::dvec3 p = a + (b - a) * random.uniform(0, 1);
        return random.chance(0.5) ? p : p + (c - p) * random.uniform(0, 1);
    }
    if (slot < scene.first_slot[2]) {
        const SphereRecord& s = scene.spheres[slot - scene.first_slot[1]];
        return point_of(s) + random.direction() * double{s.radius};
    }
    const AffineRecord& a = scene.affines[slot - scene.first_slot[2]];
    const AffineShadingRecord& forward = scene.affine_shading[slot - scene.first_slot[2]];
    glm::dvec3 p = random.direction(), q(a.translation[0], a.translation[1], a.translation[2]);
    if (slot >= scene.first_slot[3]) p.y = random.chance(0.5) ? std::copysign(0.5, p.y) : 0.5 * p.y;
    const double radius = slot >= scene.first_slot[3] ? 1 + double{a.taper} * p.y : 1;
    p.x *= radius, p.z *= radius;
    for (int row = 0; row < 3; ++row)
        for (int c = 0; c < 3; ++c) q[row] += double{forward.world_from_object[3 * row + c]} * p[c];
    return q;
}

Rays rays_to_lamp(const SceneArrays& scene, std::uint64_t count, Random& random) {
    Rays rays;
    const double far = random.chance(0.3) ? random.magnitude(0.1, 30) : 1,
                 length = random.chance(0.7) ? 1 : random.magnitude(0.1, 10);
    const glm::dvec3 lamp = random_target(scene, random) * far, middle = random_target(scene, random);
    const double spread = random.chance(0.3) ? random.magnitude(1e-3, 1) : 0;
    const double blur = random.chance(0.5) ? random.magnitude(1e-7, 1e-3) : 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 past = spread > 0 ? middle + random.point(spread) : random_target(scene, random);
        const glm::dvec3 end = lamp + random.point(blur);
        const glm::dvec3 o = end + (past - end) * (random.chance(0.3) ? 1 : random.uniform(0.5, 3));
        rays.add(o, (end - o) * length);
        rays.add_range(0, static_cast<float>(1 / length));
    }
    return rays;
}

Rays random_rays(const SceneArrays& scene, std::uint64_t count, double farthest, Random& random) {
    const int kind = random.below(9);
    if (kind == 8) return rays_to_lamp(scene, count, random);
    Rays rays;
    const bool ranged = random.chance(0.3);
    const glm::dvec3 eye = random.point(3), way = random.direction();
    const double length = random.chance(0.5) ? 1 : random.magnitude(1e-3, 1e3), cone = random.magnitude(1e-3, 1);
    const glm::dvec3 middle = random_target(scene, random);
    for (std::uint64_t i = 0; i < count; ++i) {
        glm::dvec3 o = random.point(1.5), d = random.direction();
        switch (kind) {
        case 0: // a camera
            o = eye, d = glm::normalize(middle - eye) + random.point(cone);
            break;
        case 1: // a sun
            d = way;
            break;
        case 2: // everything
            break;
        case 3: // along the axes and in their planes, from lattice points; zeros of both signs
            o = glm::dvec3(random.below(9) - 4, random.below(9) - 4, random.below(9) - 4) * 0.25;
            d = glm::dvec3(random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
            for (int axis = 0; axis < 3; ++axis)
                if (d[axis] == 0 && random.chance(0.5)) d[axis] = -0.0;
            break;
        case 4: // from far away
            o = random.direction() * random.magnitude(3, farthest), d = random_target(scene, random) - o;
            break;
        case 5:
            o = eye, d = random_target(scene, random) - o;
            break;
        case 6: // from one surface to the next
            o = random_target(scene, random), d = random_target(scene, random) - o;
            break;
        default: // ties between the axes
            d = glm::dvec3(random.chance(0.5) ? 1 : -1, random.chance(0.5) ? 1 : -1, random.chance(0.5) ? 1 : -1) * way.x;
        }
        rays.add(o, d * length);
        if (!ranged) continue;
        const float lo = random.chance(0.7) ? static_cast<float>(random.uniform(0, 1.5) / length) : 0;
        const float hi = random.chance(0.7) ? lo + static_cast<float>(random.uniform(0, 1.5) / length)
                                            : std::numeric_limits<float>::infinity();
        rays.add_range(lo, hi);
    }
    return rays;
}

SceneDescription scaled_scene(SceneDescription scene, int k) {
    const double s = std::ldexp(1.0, k);
    scene.camera.position *= s, scene.camera.look_at *= s, scene.camera.near *= s;
    for (Object& object : scene.objects) {
        if (auto* sphere = std::get_if<Sphere>(&object.shape)) sphere->radius *= s, sphere->position *= s;
        if (auto* cylinder = std::get_if<Cylinder>(&object.shape)) cylinder->radius *= s, cylinder->height *= s;
        if (auto* cone = std::get_if<Cone>(&object.shape)) cone->base_radius *= s, cone->apex_radius *= s, cone->height *= s;
        if (auto* plane = std::get_if<Plane>(&object.shape)) plane->position *= s;
        if (auto* mesh = std::get_if<Mesh>(&object.shape))
            for (glm::dvec3& p : mesh->positions) p *= s;
        for (Transformation& t : object.transformations)
            if (auto* translation = std::get_if<Translation>(&t)) translation->translate *= s;
    }
    for (Light& any : scene.lights)
        std::visit(
            [s](auto& light) {
                if constexpr (requires { light.position; }) {
                    light.position *= s, light.radius *= s;
                    light.attenuation[1] /= s, light.attenuation[2] /= s * s;
                }
            },
            any);
    return scene;
}

SceneDescription random_lit_scene(PrimitiveKind kind, Placing placing, int count, Random& random) {
    SceneDescription scene = random_scene(kind, placing, count, random);
    for (Object& object : scene.objects) {
        Material& m = object.material;
        m.ambient = glm::dvec3(0.2);
        m.diffuse = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
        if (random.chance(0.4)) m.specular = glm::dvec3(0.5), m.shininess = random.uniform(1, 50);
        if (random.chance(0.3)) m.reflective = glm::dvec3(random.uniform(0, 1));
        if (random.chance(0.3)) m.transmissive = glm::dvec3(random.uniform(0, 1));
        if (random.chance(0.2)) m.refraction = random.uniform(1, 2);
    }
    glm::dvec3 middle(0);
    int bounded = 0;
    for (const Object& object : scene.objects)
        for (const Transformation& t : object.transformations)
            if (const auto* translation = std::get_if<Translation>(&t)) middle += translation->translate, ++bounded;
    if (bounded > 0) middle /= bounded;
    scene.lights.emplace_back(AmbientLight{glm::dvec3(0.3)});
    for (int i = random.below(4); i >= 0; --i) {
        const glm::dvec3 color(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1));
        const glm::dvec3 position = middle + random.direction() * random.uniform(2, 20);
        if (i % 3 == 0) scene.lights.emplace_back(PointLight{color, position, {1, random.uniform(0, 0.2), 0.01}, 0});
        if (i % 3 == 1) scene.lights.emplace_back(DirectionalLight{color, random.direction(), 0});
        if (i % 3 == 2) scene.lights.emplace_back(SpotLight{color, position, middle - position, 40, {1, 0, 0.02}, 0});
    }
    Camera& camera = scene.camera;
    camera.position = middle + random.direction() * random.uniform(3, 12);
    camera.look_at = middle;
    camera.up = random.direction();
    camera.background = {0.1, 0.2, 0.3};
    return scene;
}

} // namespace lanecast::selftest
