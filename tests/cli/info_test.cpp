// lanecast check and info: the whole text on a small scene.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

#include <sstream>

using namespace lanecast::test;

namespace {

const std::filesystem::path here = small_scene().parent_path();

/// Without the lines that depend on the machine and the build.
std::string portable(const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("instruction sets") && !line.starts_with("precisions")) out += line + "\n";
    return out;
}

} // namespace

TEST_CASE("check: ok, counts, warnings on the standard error; nothing is written") {
    Outcome outcome = run({"check", "small.json"}, {.directory = here});
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "small.json: ok, 5 objects, 4 lights, 1 warning\n");
    CHECK(outcome.err.starts_with("small.json:17:5: warning: /objects/4: 1 degenerate triangle was dropped\n"));
    outcome = run({"check", "small.json", "--quiet"}, {.directory = here});
    CHECK(outcome.code == 0);
    CHECK((outcome.out + outcome.err).empty());

    const TemporaryDirectory directory;
    put(directory.path / "empty.json", R"({"camera": {}, "objects": [], "lights": []})");
    outcome = run({"check", "empty.json"}, {.directory = directory.path});
    CHECK(outcome.out == "empty.json: ok, 0 objects, 0 lights\n");
    CHECK(outcome.err.empty());
    CHECK(run({"info", "empty.json"}, {.directory = directory.path}).code == 0);
    CHECK(names_in(directory.path).size() == 1);
}

TEST_CASE("info: the text") {
    const Outcome outcome = run({"info", "small.json", "--quiet"}, {.directory = here});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "instruction sets scalar"));
    CHECK(contains(outcome.out, "(used)"));
    CHECK(contains(outcome.out, "\nprecisions       fast"));
    CHECK(contains(outcome.out, ", balanced (used), precise"));
    CHECK(contains(outcome.out, ", reference\n"));
    const Outcome reference = run({"info", "small.json", "--quiet", "--precision", "reference"}, {.directory = here});
    CHECK(contains(reference.out, "instruction sets scalar (used)"));
    CHECK(contains(reference.out, ", reference (used)\n"));
    CHECK(portable(outcome.out) == content_of(here / "small.info.txt"));
}

TEST_CASE("info: what is modelled follows the switches") {
    const auto info = [](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"info", "small.json", "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run(arguments, {.directory = here}).out;
    };
    CHECK(contains(info({"--no-transmission"}), "planes, lights, specular, shadows, reflection\n"));
    CHECK(contains(info({"--no-shadows", "--no-planes", "--no-reflections", "--no-transmission", "--no-specular"}),
                   "models           triangles, spheres, ellipsoids, cylinders, lights\n"));
    CHECK(contains(info({"--schlick", "--soft-shadows", "4", "--transmissive-shadows", "--aa", "edge"}),
                   "leaves out       cones, open cones\n"));
}

TEST_CASE("info --json") {
    const std::string json = run({"info", "small.json", "--json"}, {.directory = here}).out;
    for (const char* text :
         {"\"scene\": \"small.json\"", "\"meshes\": 1", "\"triangles\": 3", "\"triangles\": 4", "\"degenerate_triangles\": 1",
          "\"leaf_sizes\": [3, 0, 1, 0, 0, 0, 0, 0]", "\"refraction\": true", "\"exact\": true", "\"name\": \"scalar\"",
          "\"bounds_max\": [2.21", "1 degenerate triangle was dropped"}) {
        CAPTURE(text);
        CHECK(contains(json, text));
    }
}

TEST_CASE("info: cones, and what has no caps") {
    const TemporaryDirectory directory;
    put(directory.path / "cones.json", R"({"camera": {}, "lights": [], "objects": [
        {"type": "cone", "base_radius": 1, "height": 1, "material": {}},
        {"type": "cone", "base_radius": 1, "apex_radius": 0.5, "height": 1, "capped": false, "material": {}},
        {"type": "cylinder", "radius": 1, "height": 1, "capped": false, "material": {}}]})");
    const std::string text = run({"info", "cones.json", "--quiet"}, {.directory = directory.path}).out;
    CHECK(contains(text, "objects          3: 1 cylinder, 2 cones\n"));
    CHECK(contains(text, "primitives       3: 1 cone, 2 open cones\n"));
    CHECK(contains(text, "models           cones, open cones\n"));
}
