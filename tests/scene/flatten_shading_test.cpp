// Materials, lights, switches and feature bits.

#include "scene/geometry_support.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

namespace {

Material full_material() {
    Material m;
    m.ambient = {0.1, 0.2, 0.3};
    m.diffuse = {0.4, 0.5, 0.6};
    m.specular = {0.7, 0.8, 0.9};
    m.reflective = {0.15, 0.25, 0.35};
    m.transmissive = {0.45, 0.55, 0.65};
    m.shininess = 20;
    m.refraction = 1.5;
    return m;
}

SceneDescription one_sphere(const Material& material) {
    SceneDescription scene;
    scene.objects.push_back(make_object(Sphere{}));
    scene.objects[0].material = material;
    return scene;
}

MaterialRecord record_under(const RenderSettings& settings) {
    return flatten(one_sphere(full_material()), settings, 1).materials.at(0);
}

bool is_black(const float (&c)[3]) { return c[0] == 0 && c[1] == 0 && c[2] == 0; }

} // namespace

TEST_CASE("a material's fields, and each switch takes away its own and nothing else") {
    const MaterialRecord all = record_under({});
    CHECK(all.ambient[0] == 0.1f);
    CHECK(all.diffuse[1] == 0.5f);
    CHECK(all.specular[2] == 0.9f);
    CHECK(all.reflective[0] == 0.15f);
    CHECK(all.transmissive[1] == 0.55f);
    CHECK(all.shininess == 20);
    CHECK(all.refraction == 1.5f);

    bool RenderSettings::*const switches[] = {&RenderSettings::ambient,      &RenderSettings::diffuse,
                                              &RenderSettings::specular,     &RenderSettings::reflections,
                                              &RenderSettings::transmission, &RenderSettings::refraction};
    for (int off = 0; off < 6; ++off) {
        RenderSettings settings;
        settings.*switches[off] = false;
        const MaterialRecord r = record_under(settings);
        CHECK(is_black(r.ambient) == (off == 0));
        CHECK(is_black(r.diffuse) == (off == 1));
        CHECK(is_black(r.specular) == (off == 2));
        CHECK(is_black(r.reflective) == (off == 3));
        CHECK(is_black(r.transmissive) == (off == 4));
        CHECK((r.refraction == 0) == (off == 5));
        CHECK(r.shininess == 20);
    }
}

TEST_CASE("features follow from what is used") {
    const auto features = [](Material m, RenderSettings settings = {}) { return flatten(one_sphere(m), settings, 1).features; };
    Material m;
    CHECK(features(m) == feature_spheres);
    m.specular = {0, 0, 1};
    CHECK(features(m) == (feature_spheres | feature_specular));
    m = {};
    m.refraction = 1.5; // of an opaque material: no matter
    CHECK(features(m) == feature_spheres);
    m.transmissive = {0, 1, 0};
    CHECK(features(m) == (feature_spheres | feature_transmissive | feature_refraction));
    RenderSettings straight;
    straight.refraction = false;
    CHECK(features(m, straight) == (feature_spheres | feature_transmissive));
    m = {};
    m.reflective = {1, 0, 0};
    CHECK(features(m) == (feature_spheres | feature_reflective));

    SceneDescription scene;
    scene.objects.push_back(make_object(Sphere{}, {Scale{{1, 2, 1}}}));
    scene.objects.push_back(make_object(Cylinder{}));
    scene.objects.push_back(make_object(Plane{}));
    scene.objects.push_back(make_object(triangle_mesh({{glm::dvec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})));
    CHECK(flatten(scene, {}, 1).features == (feature_ellipsoids | feature_cylinders | feature_planes | feature_triangles));
    scene.objects = {make_object(Cone{})};
    CHECK(flatten(scene, {}, 1).features == feature_cones);
    scene.objects = {make_object(Cone{1, 0.5, 1, false})};
    CHECK(flatten(scene, {}, 1).features == feature_open_cones);
    scene.objects = {make_object(Cylinder{1, 1, false})};
    CHECK(flatten(scene, {}, 1).features == feature_open_cones);
}

TEST_CASE("identical materials share a record; meshes may bring one per triangle") {
    SceneDescription scene = one_sphere(full_material());
    scene.objects.push_back(scene.objects[0]);
    scene.objects.push_back(make_object(Cylinder{}));
    Mesh mesh = triangle_mesh({{glm::dvec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               {glm::dvec3{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                               {glm::dvec3{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}});
    mesh.materials.resize(3);
    mesh.materials[0].diffuse = glm::dvec3(0.5);
    mesh.materials[1].reflective = glm::dvec3(1); // used by no triangle
    mesh.materials[2] = full_material();
    mesh.triangle_material = {2, 0, 2};
    scene.objects.push_back(make_object(mesh));
    scene.objects.push_back(make_object(triangle_mesh({{glm::dvec3{0, 0, 3}, {1, 0, 3}, {0, 1, 3}}})));
    scene.objects.back().material.diffuse = glm::dvec3(0.5);
    const SceneArrays arrays = flatten(scene, {}, 1);
    CHECK(arrays.materials.size() == 3); // full, none, grey
    const float diffuse_of_id[] = {0.4f, 0.4f, 0, 0.4f, 0.5f, 0.4f, 0.5f};
    REQUIRE(arrays.scene_id.size() == 7);
    for (std::uint32_t slot = 0; slot < 7; ++slot)
        CHECK(arrays.materials[arrays.material[slot]].diffuse[0] == diffuse_of_id[arrays.scene_id[slot]]);
}

TEST_CASE("lights keep the file's order, ambient apart, lengths normalised") {
    SceneDescription scene = one_sphere({});
    scene.objects[0] = make_object(Sphere{4, {0, 0, 0}}); // scale 1/4
    scene.camera.background = {0.1, 0.2, 0.3};
    scene.lights.emplace_back(SpotLight{{1, 2, 3}, {4, 8, -4}, {0, -9, 0}, 60, {1, 2, 3}, 0.5});
    scene.lights.emplace_back(AmbientLight{{0.5, 0.25, 0.125}});
    scene.lights.emplace_back(DirectionalLight{{1, 1, 1}, {0, 3, 4}, 60});
    scene.lights.emplace_back(PointLight{{7, 7, 7}, {0, 0, 8}, {0, 0.5, 0}, 0});
    const SceneArrays arrays = flatten(scene, {}, 1);
    REQUIRE(arrays.lights.size() == 3);
    CHECK(view(arrays).light_count == 3);
    const LightRecord& spot = arrays.lights[0];
    CHECK(spot.kind == LightKind::spot);
    CHECK(spot.color[2] == 3);
    CHECK(spot.position[1] == 2);
    CHECK(spot.direction[1] == -1);
    CHECK(spot.cos_cutoff == 0.5f);
    CHECK(spot.attenuation[0] == 1);
    CHECK(spot.attenuation[1] == 8);
    CHECK(spot.attenuation[2] == 48);
    CHECK(spot.radius == 0.125f);
    const LightRecord& sun = arrays.lights[1];
    CHECK(sun.kind == LightKind::directional);
    CHECK(sun.direction[1] == 0.6f);
    CHECK(sun.direction[2] == 0.8f);
    CHECK(double{sun.radius} == doctest::Approx(0.5));
    CHECK(arrays.lights[2].kind == LightKind::point);
    CHECK(arrays.lights[2].position[2] == 2);
    CHECK(arrays.lights[2].attenuation[1] == 2);
    CHECK(arrays.ambient[0] == 0.5f);
    CHECK(arrays.ambient[2] == 0.125f);
    CHECK(arrays.background[1] == 0.2f);
    CHECK((arrays.features & feature_lights) != 0);
    CHECK((arrays.features & feature_soft_lights) == 0);

    RenderSettings settings;
    settings.soft_shadows = 16;
    settings.ambient = false;
    const SceneArrays soft = flatten(scene, settings, 1);
    CHECK((soft.features & feature_soft_lights) != 0);
    CHECK(soft.ambient[0] == 0);
}

TEST_CASE("spot cones at the limits") {
    for (const auto& [degrees, cosine] : {std::pair{180.0, -2.0}, {90.0, 0.0}, {45.0, std::sqrt(0.5)}, {120.0, -0.5}}) {
        SceneDescription scene = one_sphere({});
        scene.lights.emplace_back(SpotLight{{1, 1, 1}, {0, 5, 0}, {0, -1, 0}, degrees, {1, 0, 0}, 0});
        CHECK(double{flatten(scene, {}, 1).lights[0].cos_cutoff} == doctest::Approx(cosine));
    }
}

TEST_CASE("attenuation in a scene of any size divides light as the file says") {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        SceneDescription scene;
        const double size = std::exp(random.uniform(-10, 10)), linear = random.uniform(0, 1) / size,
                     quadratic = random.uniform(0, 1) / (size * size);
        scene.objects.push_back(make_object(Sphere{size, random.point(size)}));
        scene.lights.emplace_back(PointLight{{1, 1, 1}, random.point(size), {1, linear, quadratic}, 0});
        const SceneArrays arrays = flatten(scene, {}, 1);
        const double d = size * random.uniform(0, 2), own = d * arrays.normalisation.scale;
        const float* a = arrays.lights[0].attenuation;
        REQUIRE(double{a[0]} + double{a[1]} * own + double{a[2]} * own * own ==
                doctest::Approx(1 + linear * d + quadratic * d * d).epsilon(1e-6));
    }
}
