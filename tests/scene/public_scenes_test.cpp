#include "scene/error.hpp"
#include "scene/load_scene.hpp"

#include "scene/shared_files.hpp"

#include <chrono>

using namespace lanecast;

TEST_CASE("the public scenes load") {
    const auto scenes = shared_directory("scenes");
    if (!scenes) return;
    struct Expected {
        const char* file;
        std::size_t objects, lights, warnings;
    };
    for (const auto& [file, objects, lights, warnings] :
         {Expected{"c.json", 5, 4, 0}, {"c_transformed.json", 5, 4, 0}, {"cornell.json", 8, 256, 0}, {"e.json", 6, 5, 0}, {"g.json", 6, 5, 0},
          {"g_schlicks.json", 6, 5, 0}, {"i.json", 5, 2, 0}, {"spheres164.json", 165, 4, 0}, {"trailing_text.json", 4, 4, 1},
          {"typo_and_large_mesh.json", 4, 4, 1}}) {
        CAPTURE(file);
        const LoadedScene scene = load_scene(*scenes / file);
        CHECK(scene.description.objects.size() == objects);
        CHECK(scene.description.lights.size() == lights);
        CHECK(scene.warnings.size() == warnings);
        for (const std::string& warning : scene.warnings) MESSAGE(warning);
    }
}

TEST_CASE("a colour of four components is an error") {
    const auto scenes = shared_directory("scenes");
    if (!scenes) return;
    try {
        (void)load_scene(*scenes / "four_component_colour.json");
        FAIL("loaded");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::scene);
        const std::string message = error.what();
        MESSAGE(message);
        CHECK(message.find("four_component_colour.json:17:25: error: /objects/0/material/transmissive: must be a colour [r, g, b], got a list of 4\n") !=
              std::string::npos);
    }
}
TEST_CASE("times") {
    const auto t0 = std::chrono::steady_clock::now();
    auto time = [&, last = t0](const char* what) mutable {
        const auto now = std::chrono::steady_clock::now();
        MESSAGE(what << " " << std::chrono::duration<double, std::milli>(now - last).count() << " ms");
        last = now;
    };
    const auto scenes = shared_directory("scenes"), assets = shared_directory("assets");
    for (int i = 0; i < 3; ++i) {
        (void)load_scene(*scenes / "typo_and_large_mesh.json");
        time("typo");
        for (const char* f : {"dragon/dragon_vrip.ply", "sponza_crytek/sponza.obj", "bunny/bun_zipper.ply", "sanmiguel/sanmiguel_part.ply", "cornell/cornell_box.obj","spot/spot.obj","suzanne/suzanne.obj","teapot/teapot.obj"}) {
            const std::string text = std::string(R"({"camera":{},"lights":[],"objects":[{"type":"mesh","file":")") + f + "\"}]}";
            LoadedScene s = parse_scene(text, "x", *assets);
            const Mesh& m = std::get<Mesh>(s.description.objects[0].shape);
            time(f);
            MESSAGE(m.positions.size() << " " << m.triangles.size()<<" "<<m.materials.size());
            for (const std::string& warning : s.warnings) MESSAGE(warning);
        }
    }
}
