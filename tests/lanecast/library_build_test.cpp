// The public interface: what a scene is built from, and what is refused.

#include "lanecast/library_support.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

#include <doctest/doctest.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

struct OneHit {
    float t = 0, n[3] = {}, u = 0, v = 0;
    std::uint32_t object = 0, primitive = 0;
};

OneHit shoot(const Scene& scene, const std::array<float, 3>& o, const std::array<float, 3>& d) {
    RayArrays rays{&o[0], &o[1], &o[2], &d[0], &d[1], &d[2]};
    rays.count = 1;
    OneHit hit;
    scene.closest_hit(rays, {&hit.t, &hit.object, &hit.primitive, &hit.n[0], &hit.n[1], &hit.n[2], &hit.u, &hit.v});
    return hit;
}

/// A file that goes when this does.
struct TemporaryFile {
    std::filesystem::path path;
    TemporaryFile(const std::string& ending, const std::string& text)
        : path(std::filesystem::temp_directory_path() / ("lanecast_library_" + std::to_string(::getpid()) + ending)) {
        std::ofstream(path) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
};

/// The message of what `build` throws; empty: nothing.
template <class Build>
std::string fault(Build&& build) {
    try {
        build();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

constexpr float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 4, 1, 0, 4, 0, 1, 4};
constexpr std::uint32_t triangles[] = {3, 4, 5, 0, 1, 2};

TEST_CASE("triangles and meshes are numbered as the caller numbers them, degenerate ones included") {
    const std::uint32_t indices[] = {0, 0, 1, 3, 4, 5, 2, 2, 2, 0, 1, 2};
    const MeshArrays meshes[] = {{corners, 6, nullptr, 0}, {corners, 6, indices, 4}};
    const Scene scene(meshes);
    CHECK(scene.facts().triangles == 2);
    const OneHit above = shoot(scene, {0.25f, 0.5f, 9}, {0, 0, -2});
    CHECK(above.object == 1);
    CHECK(above.primitive == 1);
    CHECK(above.t == 2.5f);
    CHECK(above.u == 0.25f);
    CHECK(above.v == 0.5f);
    CHECK(above.n[2] == 1);
    const OneHit below = shoot(scene, {0.25f, 0.5f, -1}, {0, 0, 1});
    CHECK(below.primitive == 3);
    CHECK(below.n[2] == 1); // outwards, not towards the ray
}

TEST_CASE("without indices every three vertices are a triangle") {
    const Scene scene({corners, 6, nullptr, 2});
    CHECK(shoot(scene, {0.25f, 0.25f, 9}, {0, 0, -1}).primitive == 1);
    CHECK(shoot(scene, {0.25f, 0.25f, -9}, {0, 0, 1}).primitive == 0);
}

TEST_CASE("nothing to hit, and no rays") {
    for (const Scene& scene : {Scene(std::span<const MeshArrays>()), Scene(MeshArrays{}), Scene({corners, 6, triangles, 0})}) {
        CHECK(scene.facts().triangles == 0);
        CHECK(shoot(scene, {0, 0, 0}, {0, 0, 1}).object == no_hit);
        scene.closest_hit({}, {});
        scene.any_hit({}, nullptr);
    }
}

TEST_CASE("the scene does not need the caller's arrays, and can be moved") {
    std::vector<float> positions(std::begin(corners), std::end(corners));
    std::vector<std::uint32_t> indices(std::begin(triangles), std::end(triangles));
    Scene built({positions.data(), 6, indices.data(), 2});
    positions.assign(positions.size(), 0);
    indices.assign(indices.size(), 0);
    const Scene scene = std::move(built);
    CHECK(shoot(scene, {0.25f, 0.25f, 9}, {0, 0, -1}).t == 5);
}

TEST_CASE("faults name what is wrong") {
    const std::uint32_t beyond[] = {0, 1, 6};
    CHECK(fault([&] { Scene({corners, 6, beyond, 1}); }) == "mesh 0: index 6 is out of range: there are 6 vertices");
    CHECK(fault([&] { Scene({corners, 6, nullptr, 3}); }) == "mesh 0: without indices every triangle needs three vertices");
    CHECK(fault([&] { Scene({corners, 1, triangles, 0, 10}); }).find("stride") != std::string::npos);
    for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 1e31f}) {
        const float one[] = {0, bad, 0};
        const MeshArrays meshes[] = {{corners, 6, triangles, 2}, {one, 1, nullptr, 0}};
        CHECK(fault([&] { Scene{meshes}; }) == "mesh 1: coordinates must be numbers between -1e30 and 1e30");
    }
    const MeshArrays good{corners, 6, triangles, 2};
    CHECK(fault([&] { Scene(good, {.isa = "neon"}); }).find("neon") != std::string::npos);
    CHECK(fault([&] { Scene(good, {.bvh = "best"}); }).find("best") != std::string::npos);
    CHECK(fault([&] { Scene(good, {.precision = "rough"}); }).find("rough") != std::string::npos);
    CHECK(fault([&] { Scene(std::filesystem::path("/nowhere/at.ply")); }).find("/nowhere/at.ply") != std::string::npos);
    CHECK(fault([&] { Scene(std::filesystem::path("/nowhere/at.json")); }).find("/nowhere/at.json") != std::string::npos);
}

TEST_CASE("the reference answers in double") {
    const Scene scene({corners, 6, triangles, 2}, {.precision = "reference"});
    CHECK(scene.facts().isa == "scalar");
    CHECK(shoot(scene, {0.25f, 0.25f, 9}, {0, 0, -1}).t == 5);
}

TEST_CASE("fast answers where there is fused multiply-add, and is refused by name elsewhere") {
    const auto scene_on = [](const char* isa) { return Scene({corners, 6, triangles, 2}, {.isa = isa, .precision = "fast"}); };
    CHECK(fault([&] { scene_on("sse4.2"); }).find("precision 'fast'") != std::string::npos);
    const std::string refused = fault([&] { scene_on("auto"); });
    if (!refused.empty()) {
        CHECK(refused.find("precision 'fast'") != std::string::npos);
        return;
    }
    const Scene scene = scene_on("auto");
    CHECK((scene.facts().isa == "avx2" || scene.facts().isa == "avx512"));
    CHECK(shoot(scene, {0.25f, 0.25f, 9}, {0, 0, -1}).t == 5);
}

TEST_CASE("a mesh from a file") {
    const TemporaryFile file(".obj", "v 0 0 3\nv 1 0 3\nv 0 1 3\nf 1 2 3\n");
    const Scene scene(file.path);
    CHECK(shoot(scene, {0.25f, 0.25f, 9}, {0, 0, -1}).t == 6);
}

TEST_CASE("a scene from a file: objects in its order, weights as the file orders the vertices") {
    const TemporaryFile file(".json", R"({"camera": {}, "lights": [], "objects": [
        {"type": "plane", "position": [0, -3, 0], "normal": [0, 1, 0], "material": {}},
        {"type": "sphere", "radius": 1, "position": [20, 0, 0], "material": {}},
        {"type": "mesh", "triangles": [[[9, 9, 9], [9, 9, 8], [9, 8, 8]], [[0, 0, 0], [1, 0, 0], [0, 1, 0]]], "material": {},
         "transformations": [{"type": "scale", "scale": [-1, 1, 1]}]}]})");
    const Scene scene(file.path);
    const OneHit plane = shoot(scene, {0, 1, 0}, {0, -2, 0});
    CHECK(plane.object == 0);
    CHECK(plane.primitive == 0);
    CHECK(plane.t == 2);
    CHECK(plane.n[1] == 1);
    const OneHit sphere = shoot(scene, {20, 0, 9}, {0, 0, -1});
    CHECK(sphere.object == 1);
    CHECK(sphere.t == doctest::Approx(8));
    CHECK(sphere.n[2] == doctest::Approx(1));
    CHECK(sphere.u == 0);
    const OneHit inside = shoot(scene, {20, 0, 0}, {0, 0, -1});
    CHECK(inside.n[2] == doctest::Approx(-1)); // outwards
    const OneHit mesh = shoot(scene, {-0.25f, 0.5f, 9}, {0, 0, -1});
    CHECK(mesh.object == 2);
    CHECK(mesh.primitive == 1);
    CHECK(mesh.u == doctest::Approx(0.25));
    CHECK(mesh.v == doctest::Approx(0.5));
    CHECK(mesh.n[2] == doctest::Approx(1)); // mirroring keeps the outside outside
}

} // namespace
