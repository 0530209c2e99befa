// Records of every kind of primitive, and the numbering, against what the description says.

#include "cli/selftest/scenes.hpp"
#include "scene/error.hpp"
#include "scene/geometry_support.hpp"
#include "scene/normalise.hpp"
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

glm::dvec3 vec(const float* v) { return {v[0], v[1], v[2]}; }

/// Corner `v` of the triangle in a slot, from its leaf's block.
glm::vec3 corner(const SceneArrays& arrays, std::uint32_t slot, std::uint32_t v) {
    const std::uint32_t word = arrays.triangles[slot].block, n = (word >> 3 & 7u) + 1, lane = word & 7u;
    const auto* rows = reinterpret_cast<const float*>(arrays.arena.get() + std::size_t{word >> 6} * 64);
    return {rows[(3 * v) * n + lane], rows[(3 * v + 1) * n + lane], rows[(3 * v + 2) * n + lane]};
}

glm::dvec3 times(const float* row_major, const glm::dvec3& p) {
    return {glm::dot(vec(row_major), p), glm::dot(vec(row_major + 3), p), glm::dot(vec(row_major + 6), p)};
}

Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}; // counter-clockwise from outside
    return mesh;
}

std::uint32_t slot_of(const SceneArrays& arrays, std::uint32_t scene_id) {
    const auto place = std::find(arrays.scene_id.begin(), arrays.scene_id.end(), scene_id);
    REQUIRE(place != arrays.scene_id.end());
    return static_cast<std::uint32_t>(place - arrays.scene_id.begin());
}

} // namespace

TEST_CASE("each primitive of random scenes is the one its scene id names") {
    Random random(1);
    std::uint32_t dropped = 0;
    int checked[primitive_kind_count] = {};
    for (int i = 0; i < 1500; ++i) {
        const SceneDescription scene = random_scene(random, 1 + random.below(60));
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        const Normalisation& n = arrays.normalisation;
        std::map<std::uint32_t, std::uint32_t> slot_of_id;
        for (std::uint32_t slot = 0; slot < arrays.scene_id.size(); ++slot) slot_of_id[arrays.scene_id[slot]] = slot;
        std::uint32_t id = 0, missing = 0;
        for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
            const Object& object = scene.objects[o];
            const AffineTransform t = compose(object.transformations);
            const auto* mesh = std::get_if<Mesh>(&object.shape);
            for (std::uint32_t k = 0; k < (mesh ? mesh->triangles.size() : 1); ++k, ++id) {
                if (!slot_of_id.contains(id)) {
                    REQUIRE(mesh);
                    ++missing;
                    continue;
                }
                const std::uint32_t slot = slot_of_id[id];
                REQUIRE(arrays.object[slot] == o);
                int kind = 0;
                while (slot >= arrays.first_slot[kind + 1]) ++kind;
                ++checked[kind];
                if (mesh) {
                    REQUIRE(kind == 0);
                    glm::dvec3 expected[3];
                    const bool mirrored = is_mirroring(t.linear);
                    for (std::uint32_t v = 0; v < 3; ++v) {
                        const std::uint32_t index = mesh->triangles[k][mirrored && v > 0 ? 3 - v : v];
                        expected[v] = normalised(n, apply(t, mesh->positions[index]));
                        REQUIRE(corner(arrays, slot, v) == glm::vec3(expected[v]));
                    }
                    glm::dvec3 c[3];
                    for (std::uint32_t v = 0; v < 3; ++v) c[v] = glm::dvec3(corner(arrays, slot, v));
                    const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
                    REQUIRE(glm::length(vec(arrays.triangles[slot].normal) - normal) < 1e-6);
                } else if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
                    const glm::dvec3 centre = normalised(n, apply(t, sphere->position));
                    if (kind == 1) {
                        const SphereRecord& record = arrays.spheres[slot - arrays.first_slot[1]];
                        REQUIRE(glm::length(vec(record.centre) - centre) < 1e-7);
                        const double radius = sphere->radius * glm::length(t.linear[0]) * n.scale;
                        REQUIRE(std::abs(double{record.radius} - radius) < 1e-7 * radius);
                    } else {
                        REQUIRE(kind == 2);
                        REQUIRE(classify(t.linear) == TransformClass::affine);
                    }
                } else if (std::holds_alternative<Plane>(object.shape)) {
                    REQUIRE(kind == 6);
                } else {
                    const auto* cylinder = std::get_if<Cylinder>(&object.shape);
                    const auto* cone = std::get_if<Cone>(&object.shape);
                    REQUIRE(kind == ((cylinder ? cylinder->capped : cone->capped) ? (cylinder ? 3 : 4) : 5));
                }
                if (kind >= 2 && kind <= 5) { // points on the true body are on the unit one, and back
                    const AffineRecord& record = arrays.affines[slot - arrays.first_slot[2]];
                    const AffineShadingRecord& shading = arrays.affine_shading[slot - arrays.first_slot[2]];
                    const auto* cylinder = std::get_if<Cylinder>(&object.shape);
                    const auto* cone = std::get_if<Cone>(&object.shape);
                    const double radius = cone ? 0.5 * (cone->base_radius + cone->apex_radius) : cylinder ? cylinder->radius : 0;
                    const double height = cone ? cone->height : cylinder ? cylinder->height : 0;
                    const double taper = cone ? (cone->apex_radius - cone->base_radius) / radius : 0;
                    REQUIRE(std::abs(double{record.taper} - taper) <= 1e-7 * std::abs(taper));
                    for (int sample = 0; sample < 4; ++sample) {
                        const glm::dvec3 q = random.direction();
                        const auto* s = std::get_if<Sphere>(&object.shape);
                        const glm::dvec3 body = s ? s->position + s->radius * q : glm::dvec3(radius, height, radius) * q;
                        const glm::dvec3 world = normalised(n, apply(t, body)), from_centre = world - vec(record.translation);
                        const double tolerance =
                            1e-6 * (1 + glm::length(world) * glm::length(times(record.object_from_world, from_centre)) /
                                            glm::length(from_centre));
                        REQUIRE(glm::length(times(record.object_from_world, from_centre) - q) < 30 * tolerance);
                        REQUIRE(glm::length(times(shading.world_from_object, q) - from_centre) < 3e-6);
                    }
                }
            }
        }
        REQUIRE(missing == arrays.degenerate_triangles);
        dropped += missing;
    }
    CHECK(dropped > 100);
    for (const int count : checked) CHECK(count > 1000);
}

TEST_CASE("shared vertices stay shared, mirrored or not the outside stays outside") {
    for (const bool mirrored : {false, true}) {
        SceneDescription scene;
        scene.objects.push_back(make_object(
            tetrahedron(), {Rotation{{1, 2, 3}, 40}, Scale{{1.5, mirrored ? -0.7 : 0.7, 1.1}}, Translation{{0.1, 0.2, 0.3}}}));
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        const AffineTransform t = compose(scene.objects[0].transformations);
        const glm::dvec3 inside = normalised(arrays.normalisation, apply(t, {0.2, 0.2, 0.2}));
        std::map<std::array<float, 3>, int> uses;
        for (std::uint32_t slot = 0; slot < 4; ++slot) {
            const glm::vec3 v0 = corner(arrays, slot, 0);
            CHECK(glm::dot(vec(arrays.triangles[slot].normal), glm::dvec3(v0) - inside) > 0);
            for (std::uint32_t v = 0; v < 3; ++v) {
                const glm::vec3 p = corner(arrays, slot, v);
                ++uses[{p.x, p.y, p.z}];
            }
        }
        CHECK(uses.size() == 4);
    }
}

TEST_CASE("planes: unit normals, normalised distances, dropped with their materials when off; ids stay") {
    SceneDescription scene;
    scene.objects.push_back(make_object(Plane{{0, -2, 0}, {0, 5, 0}}));
    scene.objects[0].material.reflective = glm::dvec3(1);
    scene.objects.push_back(make_object(Sphere{2, {0, 0, 0}}));
    scene.objects.push_back(make_object(Plane{{1, 1, 1}, {1e200, 1e200, 1e200}}));
    const SceneArrays arrays = flatten(scene, scene.render, 1);
    REQUIRE(arrays.planes.size() == 2);
    CHECK(arrays.planes[0].normal[1] == 1);
    CHECK(arrays.planes[0].distance == -1); // scale 1/2
    CHECK(double{arrays.planes[1].normal[0]} == doctest::Approx(std::sqrt(1.0 / 3)));
    CHECK(double{arrays.planes[1].distance} == doctest::Approx(std::sqrt(3.0) / 2));
    CHECK(arrays.scene_id == std::vector<std::uint32_t>{1, 0, 2});
    CHECK((arrays.features & (feature_planes | feature_reflective)) == (feature_planes | feature_reflective));
    CHECK(arrays.first_slot[6] == 1);
    CHECK(arrays.first_slot[7] == 3);

    RenderSettings off;
    off.planes = false;
    const SceneArrays without = flatten(scene, off, 1);
    CHECK(without.planes.empty());
    CHECK(without.scene_id == std::vector<std::uint32_t>{1});
    CHECK((without.features & (feature_planes | feature_reflective)) == 0);
    CHECK(without.materials.size() == 1);
    CHECK(without.first_slot[7] == 1);
}

TEST_CASE("a scene of planes has no tree, and an empty one nothing") {
    SceneDescription scene;
    CHECK(view(flatten(scene, scene.render, 2)).leaf_count == 0);
    scene.objects.push_back(make_object(Plane{}));
    const SceneArrays arrays = flatten(scene, scene.render, 2);
    CHECK(view(arrays).leaf_count == 0);
    CHECK(arrays.max_coordinate == 0);
    CHECK(arrays.bounds_min.x > arrays.bounds_max.x);
    CHECK(view(arrays).first_slot[7] == 1);
}

TEST_CASE("degenerate triangles are dropped and counted, slivers are kept, ids have gaps") {
    SceneDescription scene;
    const glm::dvec3 a(-1, 0, 0), b(1, 0, 0), c(0, 1, 0);
    scene.objects.push_back(
        make_object(triangle_mesh({{a, b, c}, {a, b, a}, {a, b, b * 0.5}, {a, b, {0.5, 1e-30, 0}}, {c, b, a}})));
    const SceneArrays arrays = flatten(scene, scene.render, 1);
    CHECK(arrays.degenerate_triangles == 2);
    CHECK(arrays.warnings == std::vector<std::string>{"/objects/0: 2 degenerate triangles were dropped"});
    std::vector<std::uint32_t> ids = arrays.scene_id;
    std::sort(ids.begin(), ids.end());
    CHECK(ids == std::vector<std::uint32_t>{0, 3, 4});
    CHECK(arrays.triangles[slot_of(arrays, 3)].normal[2] == 1);
    CHECK(arrays.triangles[slot_of(arrays, 4)].normal[2] == -1);
    CHECK(check_tree(arrays) == "");

    SceneDescription nothing;
    nothing.objects.push_back(make_object(triangle_mesh({{a, b, a}, {b, b, b}})));
    const SceneArrays empty = flatten(nothing, nothing.render, 1);
    CHECK(empty.degenerate_triangles == 2);
    CHECK(check_tree(empty) == "");

    scene.objects.insert(scene.objects.begin(), make_object(Sphere{}));
    scene.objects.insert(scene.objects.begin(), make_object(triangle_mesh({{a, b, c}})));
    scene.objects[2].name = "sheet";
    scene.objects.push_back(make_object(triangle_mesh({{a, b, a}})));
    const std::string both = "/objects/2 (\"sheet\"): 2 degenerate triangles were dropped (3 in all, in 2 meshes)";
    CHECK(flatten(scene, scene.render, 2).warnings == std::vector<std::string>{both});
}

TEST_CASE("vertices that no triangle uses do not count") {
    SceneDescription scene;
    Mesh mesh = tetrahedron();
    mesh.positions.emplace_back(1e30, 0, 0);
    scene.objects.push_back(make_object(mesh));
    const SceneArrays arrays = flatten(scene, scene.render, 1);
    CHECK(arrays.bounds_max == glm::dvec3(1));
    CHECK(arrays.normalisation.scale == 2);
    CHECK(arrays.normalisation.exact);
}

TEST_CASE("errors and warnings name the object") {
    SceneDescription scene;
    scene.objects.push_back(make_object(Sphere{1, {0, 0, 0}}));
    scene.objects.push_back(make_object(Sphere{1e-30, {0, 0, 0}}));
    scene.objects[1].name = "dust";
    CHECK_THROWS_WITH_AS((void)flatten(scene, scene.render, 1), doctest::Contains("/objects/1 (\"dust\")"), Error);
    scene.objects[1] = make_object(Sphere{}, {Scale{{1e200, 1e200, 1e200}}, Scale{{1e200, 1e200, 1e200}}});
    CHECK_THROWS_WITH_AS((void)flatten(scene, scene.render, 1), doctest::Contains("/objects/1"), Error);
    scene.objects[1] = make_object(Sphere{}, {Scale{{1, 1e-170, 1}}, Scale{{1, 1e-170, 1}}});
    CHECK_THROWS_WITH_AS((void)flatten(scene, scene.render, 1), doctest::Contains("/objects/1"), Error);
    scene.objects[1] = make_object(Cylinder{1, 1e-6}, {Rotation{{1, 0, 0}, 33}});
    CHECK(flatten(scene, scene.render, 1).warnings.size() == 1);
    scene.objects[1] = make_object(Cylinder{1, 1e-6});
    CHECK(flatten(scene, scene.render, 1).warnings.empty()); // along the axes nothing is lost
}

TEST_CASE("one warning for objects too small for the float grid: the smallest, and what reaches farthest from it") {
    const auto warnings = [](double size, int k) {
        SceneDescription scene;
        scene.objects.push_back(make_object(Plane{{0, -1e9, 0}, {0, 1, 0}}));
        scene.objects.push_back(make_object(Sphere{1.5, {3, 0, 0}}));
        scene.objects.push_back(make_object(triangle_mesh({{glm::dvec3{-size, 0, -size}, {-size, 0, size}, {size, 0, size}}})));
        scene.objects.push_back(make_object(Sphere{0.5}, {Scale{{1, 2, 0.5}}})); // 2 across at its longest
        scene.objects[2].name = "floor";
        scene = selftest::scaled_scene(scene, k);
        return flatten(scene, scene.render, 2).warnings;
    };
    const double limit = 0x1p17; // of the half size: beyond it the step of the grid doubles from 2^-7 to 2^-6
    for (const int k : {0, -40, 40}) CHECK(warnings(limit * 0.999, k).empty());
    for (const int k : {0, -40, 40}) {
        const std::vector<std::string> coarse = warnings(limit * 1.001, k);
        REQUIRE(coarse.size() == 1);
        CHECK(coarse[0].starts_with("/objects/3: is 128 steps of single precision across: "));
    }
    CHECK(warnings(1e6, 0) ==
          std::vector<std::string>{"/objects/3: is 32 steps of single precision across: 2 units in a scene of "
                                   "2e+06, as far as /objects/2 (\"floor\") reaches; expect rough edges and "
                                   "shadows"});
    // Where nothing is large, what lies far away does it; lights and the camera do not.
    SceneDescription scene;
    for (const double x : {0.0, 1.0, 1e6}) scene.objects.push_back(make_object(Sphere{x == 1 ? 0.5 : 1, {x, 0, 0}}));
    scene.camera.position = {1e8, 0, 0};
    const std::vector<std::string> far = flatten(scene, scene.render, 1).warnings;
    REQUIRE(far.size() == 1);
    CHECK(far[0].starts_with("/objects/1: is 32 steps"));
    CHECK(far[0].find("as far as /objects/2 reaches") != std::string::npos);
    scene.objects.pop_back();
    CHECK(flatten(scene, scene.render, 1).warnings.empty());
}

TEST_CASE("extreme ranges stay finite") {
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        SceneDescription scene;
        const double size = std::pow(10, random.uniform(-200, 200));
        for (int k = 0; k < 8; ++k) {
            const double own = size * std::pow(10, random.uniform(-12, 0));
            scene.objects.push_back(make_object(Sphere{own, random.point(size)}));
            scene.objects.push_back(
                make_object(Cylinder{own, own * random.uniform(0.001, 1000)}, {Rotation{random.direction(), 20}}));
            scene.objects.push_back(make_object(triangle_mesh({{random.point(own), random.point(own), random.point(own)}})));
        }
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        REQUIRE(check_tree(arrays) == "");
        REQUIRE(arrays.max_coordinate <= 1.001f);
        for (const AffineRecord& record : arrays.affines)
            for (const float x : record.object_from_world) REQUIRE(std::isfinite(x));
        for (const TriangleRecord& record : arrays.triangles)
            REQUIRE(glm::length(vec(record.normal)) == doctest::Approx(1).epsilon(1e-6));
    }
}
