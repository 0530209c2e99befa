// The seed tracer and Lanecast have no line in common below the scene's description: where both see the same picture of a random
// scene, either both are right or both misread issue section 3 alike.

#include "golden/picture_shares.hpp"
#include "golden/seed_tracer.hpp"
#include "render/dispatch.hpp"
#include "render/renderer.hpp"
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr int threads = 2;

struct Random {
    std::mt19937 engine;
    double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine()) * 0x1p-32); }
    bool chance(double p) { return uniform(0, 1) < p; }
    glm::dvec3 vector(double lo, double hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }
};

Material random_material(Random& random) {
    Material material;
    material.ambient = random.vector(0, 0.4);
    material.diffuse = random.vector(0, 1);
    if (random.chance(0.5)) material.specular = random.vector(0, 1), material.shininess = std::floor(random.uniform(0, 40));
    if (random.chance(0.5)) material.reflective = random.vector(0, 0.9);
    if (random.chance(0.3)) {
        material.transmissive = random.vector(0, 0.9);
        if (random.chance(0.8)) material.refraction = random.uniform(0.7, 1.8);
    }
    return material;
}

Mesh tetrahedron(Random& random) {
    Mesh mesh;
    for (int i = 0; i < 4; ++i) mesh.positions.push_back(random.vector(-1, 1));
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    return mesh;
}

Object random_object(Random& random) {
    Object object;
    object.material = random_material(random);
    if (random.chance(0.2)) {
        object.shape = Plane{random.vector(-4, -2), random.vector(-1, 1)};
        return object;
    }
    const double kind = random.uniform(0, 3);
    if (kind < 1)
        object.shape = Sphere{random.uniform(0.3, 1.5), random.vector(-0.5, 0.5)};
    else if (kind < 2)
        object.shape = Cylinder{random.uniform(0.3, 1), random.uniform(0.5, 2)};
    else
        object.shape = tetrahedron(random);
    if (random.chance(0.5)) object.transformations.push_back(Scale{random.vector(0.5, 1.5)});
    if (random.chance(0.7)) object.transformations.push_back(Rotation{random.vector(-1, 1), random.uniform(-180, 180)});
    if (random.chance(0.2)) object.transformations.push_back(Scale{random.vector(0.7, 1.4)});
    object.transformations.push_back(Translation{{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-10, -3)}});
    return object;
}

Light random_light(Random& random) {
    const glm::dvec3 color = random.vector(0, 1.6), position = random.vector(-6, 6);
    const std::array<double, 3> attenuation{1, random.chance(0.5) ? random.uniform(0, 0.1) : 0, 0.01};
    const double kind = random.uniform(0, 3);
    if (kind < 1) return DirectionalLight{color, random.vector(-1, 1), 0};
    if (kind < 2) return PointLight{color, position, attenuation, 0};
    return SpotLight{color, position, glm::dvec3(0, 0, -6) - position, random.uniform(5, 60), attenuation, 0};
}

SceneDescription random_scene(Random& random) {
    SceneDescription scene;
    scene.camera.field = random.uniform(30, 90);
    scene.camera.background = random.vector(0, 0.5);
    scene.camera.near = random.chance(0.5) ? 0 : random.uniform(0, 6);
    scene.render.depth = static_cast<int>(random.uniform(0, 6));
    scene.render.schlick = random.chance(0.5);
    for (int n = static_cast<int>(random.uniform(1, 9)); n > 0; --n) scene.objects.push_back(random_object(random));
    scene.lights.emplace_back(AmbientLight{random.vector(0, 1)});
    for (int n = static_cast<int>(random.uniform(0, 4)); n > 0; --n) scene.lights.push_back(random_light(random));
    return scene;
}

Film render_lanecast(const SceneDescription& scene, int size) {
    const SceneArrays arrays = flatten(scene, scene.render, threads);
    FrameOptions options;
    options.width = options.height = size;
    options.threads = threads;
    return render_frame(find_kernels("auto", Precision::balanced), arrays, scene.camera, scene.render, options).film;
}

Object placed(Shape shape, const glm::dvec3& at, const Transformation& transformation) {
    Object object;
    object.shape = std::move(shape);
    object.transformations = {transformation, Translation{at}};
    object.material.ambient = glm::dvec3(0.2);
    object.material.diffuse = object.material.specular = glm::dvec3(0.7);
    object.material.shininess = 4;
    return object;
}

/// Something for each fault to spoil.
SceneDescription scene_for_faults() {
    SceneDescription scene;
    scene.render.schlick = true;
    scene.camera.field = 70;
    const Rotation tilt{{1, 0, 0}, 80}, askew{{0, 0, 1}, 45};
    scene.objects.push_back(placed(Cylinder{1, 1}, {-1.5, 1.5, -5}, tilt)); // seen through both caps
    scene.objects.push_back(placed(Cylinder{0.4, 1}, {1.5, 1.5, -5}, Scale{{3, 1, 3}}));
    scene.objects.push_back(placed(Sphere{1, {}}, {-1.5, -1, -5}, askew));
    scene.objects.push_back(placed(Sphere{0.7, {}}, {1.5, -1, -4}, Scale{{1, 2, 1}}));
    scene.objects.back().material.transmissive = scene.objects.back().material.reflective = glm::dvec3(0.7);
    scene.objects.back().material.refraction = 1.5;
    scene.objects.push_back(placed(Mesh{{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}, {}, {}},
                                   {0, 0, -8}, Scale{{0.5, 0.5, 1}}));
    // a triangle whose place in the file makes a box around the eye, before a sphere that the tree visits first
    scene.objects.push_back(placed(Sphere{2, {}}, {-0.5, 4, -10}, askew));
    scene.objects.push_back(
        placed(Mesh{{{0, -2, -15}, {0, 2, -15}, {0, 0, 5}}, {{0, 1, 2}}, {}, {}, {}}, {2.5, 3, -6}, Scale{{1, 0.6, 0.15}}));
    scene.objects.back().transformations.insert(scene.objects.back().transformations.begin() + 1, Rotation{{0, 1, 0}, 90});
    scene.objects.push_back(placed(Plane{{0, -2, 0}, {0.2, 2, 0.1}}, {}, askew));
    scene.objects.back().transformations.clear();
    scene.objects.back().material.reflective = glm::dvec3(0.4);
    scene.objects.push_back(placed(Plane{{0, 9, 0}, {0, 1, 0}}, {}, askew)); // a ceiling, lit from above
    scene.objects.back().transformations.clear();
    scene.lights = {AmbientLight{glm::dvec3(0.6)}, DirectionalLight{glm::dvec3(0.9), {0.2, -1, -0.4}, 0},
                    PointLight{glm::dvec3(0.8), {-3, 4, 1}, {1, 0, 0}, 0},
                    SpotLight{glm::dvec3(0.8), {2, 5, 0}, {-0.3, -1, -0.9}, 25, {1, 0, 0}, 0}};
    return scene;
}

} // namespace

TEST_CASE("Lanecast and the seed tracer agree on random scenes") {
    constexpr int size = 48, scenes = 150;
    Random random{std::mt19937(7)};
    double off = 0;
    for (int i = 0; i < scenes; ++i) {
        const SceneDescription scene = random_scene(random);
        const Picture8 ours = plain(render_lanecast(scene, size));
        const double of_scene = share_beyond(ours, plain(render_seed(scene, scene.render, {}, size, size, threads)), 1);
        CAPTURE(i);
        CHECK(of_scene <= 0.002);
        off += of_scene / scenes;
    }
    CHECK(off <= 0.00005); // measured: none of 345,600 pixels
    MESSAGE("off by more than 1/255: " << 100 * off << " % of the pixels");
}

TEST_CASE("each fault of the seed tracer shows somewhere") {
    constexpr int size = 160;
    const SceneDescription scene = scene_for_faults();
    const auto render = [&](const SeedFaults& faults) {
        return plain(render_seed(scene, scene.render, faults, size, size, threads));
    };
    const Picture8 correct = render({}), faulty = render(all_seed_faults());
    for (const SeedFault& fault : seed_faults) {
        const std::string name = fault.name;
        CAPTURE(name);
        const double alone = share_beyond(render(with({}, fault, true)), correct, 1);
        const double without = share_beyond(render(with(all_seed_faults(), fault, false)), faulty, 1);
        CHECK(alone + without > 0);
    }
}
