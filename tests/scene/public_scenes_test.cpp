#include "scene/error.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include "scene/shared_files.hpp"

#include <string>

using namespace lanecast;

TEST_CASE("the public scenes load") {
    const auto scenes = shared_directory("scenes");
    if (!scenes) return;
    struct Expected {
        const char* file;
        std::size_t objects, lights, warnings;
    };
    for (const auto& [file, objects, lights, warnings] : {Expected{"c.json", 5, 4, 0},
                                                          {"c_transformed.json", 5, 4, 0},
                                                          {"cornell.json", 8, 256, 0},
                                                          {"e.json", 6, 5, 0},
                                                          {"g.json", 6, 5, 0},
                                                          {"g_schlicks.json", 6, 5, 0},
                                                          {"i.json", 4, 2, 0},
                                                          {"spheres164.json", 165, 4, 0},
                                                          {"trailing_text.json", 4, 4, 1},
                                                          {"typo_and_large_mesh.json", 5, 4, 1}}) {
        CAPTURE(file);
        const LoadedScene scene = load_scene(*scenes / file);
        CHECK(scene.description.objects.size() == objects);
        CHECK(scene.description.lights.size() == lights);
        CHECK(scene.warnings.size() == warnings);
        CHECK(flatten(scene.description, scene.description.render, 2).warnings.empty());
        CHECK_THROWS_AS((void)load_scene(*scenes / (warnings > 0 ? file : "four_component_colour.json"), {.strict = true}),
                        Error);
    }
    CHECK(load_scene(*scenes / "typo_and_large_mesh.json")
              .warnings[0]
              .find("typo_and_large_mesh.json:19700:17: warning: /objects/0/material/shiniess: unknown key of a material; did "
                    "you mean `shininess`?\n") != std::string::npos);
    CHECK(load_scene(*scenes / "trailing_text.json")
              .warnings[0]
              .find("trailing_text.json:77:1: warning: text after the end of the scene is ignored\n/*\n^") != std::string::npos);
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
        CHECK(message.find("four_component_colour.json:17:25: error: /objects/0/material/transmissive: must be a colour [r, g, "
                           "b], got a list of 4\n") != std::string::npos);
    }
}

TEST_CASE("the public meshes load") {
    const auto assets = shared_directory("assets");
    if (!assets) return;
    struct Expected {
        const char* file;
        std::size_t vertices, triangles, materials;
    };
    for (const auto& [file, vertices, triangles, materials] : {Expected{"dragon/dragon_vrip.ply", 437645, 871414, 0},
                                                               {"dragon/dragon_vrip_res3.ply", 22998, 47794, 0},
                                                               {"bunny/bun_zipper.ply", 35947, 69451, 0},
                                                               {"sponza_crytek/sponza.obj", 153635, 279163, 27},
                                                               {"teapot/teapot.obj", 3644, 6320, 0},
                                                               {"spot/spot.obj", 2930, 5856, 0},
                                                               {"suzanne/suzanne.obj", 507, 968, 0},
                                                               {"cornell/cornell_box.obj", 76, 36, 6}}) {
        CAPTURE(file);
        const std::string text =
            R"({"camera": {}, "lights": [], "objects": [{"type": "mesh", "file": ")" + std::string(file) + "\"}]}";
        const LoadedScene scene = parse_scene(text, "mesh.json", *assets, {.strict = true});
        const Mesh& mesh = std::get<Mesh>(scene.description.objects[0].shape);
        CHECK(mesh.positions.size() == vertices);
        CHECK(mesh.triangles.size() == triangles);
        CHECK(mesh.materials.size() == materials);
        CHECK(mesh.triangle_material.size() == (materials > 0 ? triangles : 0));
        CHECK(mesh.file == file);
    }
}
