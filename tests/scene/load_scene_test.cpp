// What the loader says about texts that are not wrong, and about those that tests/errors cannot hold.

#include "scene/error.hpp"
#include "scene/load_scene.hpp"

#include <fstream>
#include <sstream>

#include <unistd.h>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

std::string scene(const std::string& objects, const std::string& lights = "", const std::string& rest = "") {
    return "{\"camera\": {}, \"objects\": [" + objects + "], \"lights\": [" + lights + "]" + rest + "}";
}
std::string sphere(const std::string& rest) { return R"({"type": "sphere", "radius": 1, "material": {)" + rest + "}}"; }

std::vector<std::string> warnings_of(const std::string& text) { return parse_scene(text, "w.json", {}).warnings; }

std::string error_of(const std::string& text, const LoadOptions& options = {}) {
    try {
        (void)parse_scene(text, "e.json", {}, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("without look_at the camera looks down -z, wherever it is") {
    for (const std::string position : {"[0, 0, 0]", "[0, 0, -1]", "[3, -2, 7]", "[1e6, 1e6, 1e-6]"}) {
        const std::string text = R"({"camera": {"position": )" + position + R"(}, "objects": [], "lights": []})";
        const Camera camera = parse_scene(text, "c.json", {}).description.camera;
        const glm::dvec3 view = camera.look_at - camera.position;
        CHECK(view.x == 0);
        CHECK(view.y == 0);
        CHECK(view.z < 0);
    }
}

TEST_CASE("comment keys are silent everywhere, even repeated") {
    const std::string comments =
        R"("_a": {"radius": [[[]]], "radius": 1}, "comment": -1, "$schema": "scene.schema.json", "_a": 2, "comment": null)";
    const std::string text =
        R"({"camera": {)" + comments + R"(}, "objects": [{"type": "sphere", "radius": 1, "material": {)" + comments + "}, " +
        comments + R"(, "transformations": [{"type": "translate", "translate": [0, 0, 0], )" + comments +
        R"(}]}], "lights": [{"type": "ambient",
                             "color": [1, 1, 1], )" +
        comments + R"(}], "render": {"anti_aliasing": {"mode": "off", )" + comments + "}, " + comments + "}, " + comments + "}";
    CHECK(error_of(text, {.strict = true}) == "");
    CHECK(warnings_of(text).empty());
}

TEST_CASE("unknown keys are warnings with the nearest known key") {
    const auto warned = [](const std::string& key) {
        const std::vector<std::string> warnings = warnings_of(scene(sphere("\"" + key + "\": 1")));
        REQUIRE(warnings.size() == 1);
        return warnings[0].substr(0, warnings[0].find('\n'));
    };
    const std::string place = "w.json:1:73: warning: /objects/0/material/";
    CHECK(warned("shinines") == place + "shinines: unknown key of a material; did you mean `shininess`?");
    CHECK(warned("Diffuse") == place + "Diffuse: unknown key of a material; did you mean `diffuse`?");
    CHECK(warned("reflecitve") == place + "reflecitve: unknown key of a material; did you mean `reflective`?");
    CHECK(warned("refract") == place + "refract: unknown key of a material; did you mean `refraction`?"); // cut short
    CHECK(warned("texture_map") == place + "texture_map: unknown key of a material");
    CHECK(warned("a/b~c") == place + "a~1b~0c: unknown key of a material");
    CHECK(warned("") == place + ": unknown key of a material");
    CHECK(warnings_of(
              scene(R"({"type": "plane", "position": [0, 0, 0], "normal": [0, 1, 0], "material": {}, "transformations": []})"))
              .size() == 1);
}

TEST_CASE("warnings come in the order of the file, and --strict makes the first an error") {
    const std::string text = "{\"camera\": {\"fov\": 1},\n \"objects\": [" + sphere("\"gloss\": 1") +
                             "],\n \"lights\": [],\n \"render\": {\"threads\": 1},\n \"title\": \"x\"\n}\n};";
    const std::vector<std::string> warnings = warnings_of(text);
    REQUIRE(warnings.size() == 5);
    CHECK(warnings[0].starts_with("w.json:1:13: warning: /camera/fov: unknown key of the camera"));
    CHECK(warnings[1].starts_with("w.json:2:59: warning: /objects/0/material/gloss: unknown key of a material\n"));
    CHECK(warnings[2].starts_with("w.json:4:13: warning: /render/threads: unknown key of the render block\n"));
    CHECK(warnings[3].starts_with("w.json:5:2: warning: /title: unknown key of a scene\n"));
    CHECK(warnings[4] == "w.json:7:1: warning: text after the end of the scene is ignored\n};\n^");
    CHECK(error_of(text, {.strict = true}) ==
          "e.json:7:1: error: text after the end of the scene is ignored (a warning, but --strict was given)\n};\n^");
    CHECK(error_of(scene("", "", ", \"title\": 1"), {.strict = true}) ==
          "e.json:1:45: error: /title: unknown key of a scene (a warning, but --strict was given)\n" +
              scene("", "", ", \"title\": 1") + "\n" + std::string(44, ' ') + "^");
}

TEST_CASE("text after the scene: anything but white space") {
    for (const char* rest : {"x", "}", "{}", "// note", "\"", "\xff", "1e999"})
        CHECK(warnings_of(scene("") + "\n" + rest).size() == 1);
    for (const char* rest : {"", " ", "\n\r\t \n"}) CHECK(warnings_of(scene("") + rest).empty());
    CHECK(warnings_of(scene("") + std::string("\0", 1)).size() == 1);
}

TEST_CASE("a thousand unknown keys are reported once in a while") {
    std::string keys = "\"k\": 1";
    for (int i = 0; i < 100000; ++i) keys += ", \"k" + std::to_string(i) + "\": 1";
    const std::vector<std::string> warnings = warnings_of(scene(sphere(keys)));
    CHECK(warnings.size() == 51);
    CHECK(warnings.back() == "w.json: warning: 99951 more warnings");
}

TEST_CASE("a material library that every object misses is reported a few times") {
    const std::filesystem::path directory =
        std::filesystem::temp_directory_path() / ("lanecast_scene_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory);
    std::ofstream(directory / "a.obj") << "mtllib none.mtl\nv 0 0 0\nf 1 1 1\n";
    std::string objects = R"({"type": "mesh", "file": "a.obj"})";
    for (int i = 0; i < 69; ++i) objects += R"(, {"type": "mesh", "file": "a.obj"})";
    const std::vector<std::string> warnings = parse_scene(scene(objects), "w.json", directory).warnings;
    std::filesystem::remove_all(directory);
    REQUIRE(warnings.size() == 51);
    CHECK(warnings[0].find(
              "a.obj:1:8: warning: cannot read the materials `none.mtl`: No such file or directory\nmtllib none.mtl\n       ^\n"
              "w.json:1:53: note: /objects/0/file: asks for this file\n") != std::string::npos);
    CHECK(warnings[50] == "w.json: warning: 20 more warnings");
}

TEST_CASE("warnings of a mesh past the tenth are counted") {
    const std::filesystem::path directory =
        std::filesystem::temp_directory_path() / ("lanecast_scene_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory);
    for (const int count : {11, 15}) {
        std::ofstream file(directory / "a.obj");
        for (int i = 0; i < count; ++i) file << "vertex 1 2 3\n";
        file << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" << std::flush;
        const std::string object = R"({"type": "mesh", "file": "a.obj"})";
        const std::vector<std::string> warnings = parse_scene(scene(object + ", " + object), "w.json", directory).warnings;
        REQUIRE(warnings.size() == 22);
        for (const std::size_t i : {10u, 21u})
            CHECK(warnings[i].ends_with(count == 11 ? "a.obj: warning: 1 more warning" : "a.obj: warning: 5 more warnings"));
    }
    std::filesystem::remove_all(directory);
}

TEST_CASE("nesting: 64 levels are read, 65 are an error, whatever follows") {
    const auto nested = [](int depth) {
        return scene("", "",
                     ", \"_deep\": " + std::string(static_cast<std::size_t>(depth), '[') +
                         std::string(static_cast<std::size_t>(depth), ']'));
    };
    CHECK(error_of(nested(63)) == "");
    CHECK(error_of(nested(64)).find("nested too deeply: more than 64 levels") != std::string::npos);
    CHECK(error_of(std::string(10'000'000, '[')).find("e.json:1:65: error: nested too deeply") == 0);
    std::string objects;
    for (int i = 0; i < 1'000'000; ++i) objects += "{\"a\":";
    CHECK(error_of(objects).find("nested too deeply") != std::string::npos);
}

TEST_CASE("numbers: underflow is zero, huge whole numbers are numbers") {
    CHECK(error_of(scene(sphere("\"shininess\": 1e-999"))) == "");
    CHECK(error_of(scene(sphere("\"shininess\": 0." + std::string(400, '0') + "1"))) == "");
    CHECK(error_of(scene(sphere("\"shininess\": 123456789012345678901234567890"))) == "");
    CHECK(error_of(scene(sphere("\"shininess\": 1" + std::string(400, '0'))))
              .find("/objects/0/material/shininess: must be a number between -1e30 and 1e30, got 1000") != std::string::npos);
    CHECK(error_of(scene(sphere("\"shininess\": 0.1e1000"))).find(": must be a number between -1e30 and 1e30, got 0.1e1000") !=
          std::string::npos);
    CHECK(error_of(scene(sphere("\"shininess\": 1e30"))) == "");
    CHECK(error_of(scene("", "", ", \"render\": {\"depth\": 3.0}")) == "");
}

TEST_CASE("a mesh without triangles is worth a word") {
    const std::vector<std::string> warnings = warnings_of(scene(R"({"type": "mesh", "triangles": [], "material": {}})"));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("w.json:1:58: warning: /objects/0/triangles: the mesh has no triangles\n"));
}

TEST_CASE("the examples of docs/scene-format.md load without a warning") {
    std::ifstream file(std::string(LANECAST_SOURCE_DIR) + "/docs/scene-format.md");
    std::stringstream text;
    text << file.rdbuf();
    const std::string page = text.str();
    int examples = 0;
    const std::string fence = "```json\n";
    for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
        const std::size_t start = at + fence.size();
        CHECK(error_of(page.substr(start, page.find("```", start) - start), {.strict = true}) == "");
        ++examples;
    }
    CHECK(examples == 5);
}
