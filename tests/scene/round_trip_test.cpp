#include "scene/error.hpp"
#include "scene/load_scene.hpp"

#include "scene/random_scene.hpp"
#include "scene/write_scene.hpp"

#include <doctest/doctest.h>

using namespace lanecast;

TEST_CASE("random scenes, written and loaded, are the same") {
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        CAPTURE(seed);
        const Json written = to_json(RandomScene(seed).scene());
        const int indent = seed % 3 == 0 ? -1 : static_cast<int>(seed % 3);
        const std::string text =
            (seed % 5 == 0 ? "\xef\xbb\xbf" : "") + written.dump(indent, seed % 2 == 0 ? ' ' : '\t', seed % 7 == 0);
        try {
            const LoadedScene loaded = parse_scene(text, "random.json", {}, {.strict = true});
            REQUIRE(loaded.warnings.empty());
            REQUIRE(to_json(loaded.description) == written);
        } catch (const Error& error) {
            FAIL(error.what());
        }
    }
}

TEST_CASE("what a scene leaves out has the defaults of the description") {
    const LoadedScene loaded = parse_scene(R"({"camera": {}, "objects": [], "lights": []})", "empty.json", {}, {.strict = true});
    CHECK(to_json(loaded.description) == to_json(SceneDescription{}));
    CHECK(loaded.description.file == "empty.json");

    const LoadedScene sphere =
        parse_scene(R"({"camera": {}, "objects": [{"type": "sphere", "radius": 2, "material": {}}], "lights": [],
                                              "render": {"anti_aliasing": {"mode": "off"}}})",
                    "sphere.json", {}, {.strict = true});
    SceneDescription expected;
    expected.objects.resize(1);
    expected.objects[0].shape = Sphere{2, {}};
    CHECK(to_json(sphere.description) == to_json(expected));
}

TEST_CASE("a camera that is only moved still looks down -z") {
    for (const char* position : {"[0, 5, 0]", "[0, 0, -1]", "[1e20, 0, 1e20]", "[3, 4, 5]"}) {
        const Camera camera =
            parse_scene(R"({"camera": {"position": )" + std::string(position) + R"(}, "objects": [], "lights": []})",
                        "moved.json", {})
                .description.camera;
        const glm::dvec3 view = camera.look_at - camera.position;
        CHECK(view.x == 0);
        CHECK(view.y == 0);
        CHECK(view.z < 0);
    }
}
