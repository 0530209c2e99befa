// lanecast pick: the words, and lengths in the scene's units.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

using namespace lanecast::test;

namespace {

// Far from the origin and large, so that normalisation moves and scales it. The camera looks straight at a mirror.
const char* const scene = R"({
  "camera": { "position": [1000, 0, 20], "look_at": [1000, 0, 0], "background": [0.25, 0.5, 0.75], "resolution": [9, 9] },
  "objects": [
    { "type": "sphere", "name": "far", "radius": 1, "position": [0, 0, -50], "material": {} },
    { "type": "sphere", "name": "mirror", "radius": 4, "position": [1000, 0, 0],
      "material": { "ambient": [0.5, 0.5, 0.5], "diffuse": [1, 1, 1], "reflective": [0.5, 0.5, 0.5] } } ],
  "lights": [
    { "type": "ambient", "color": [0.5, 0.25, 0.125] },
    { "type": "directional", "color": [1, 1, 1], "direction": [0, 0, 1] },
    { "type": "directional", "color": [0.5, 1, 1], "direction": [0, 0, -2] } ] })";

struct Picked {
    TemporaryDirectory directory;
    Picked() { put(directory.path / "mirror.json", scene); }
    Outcome operator()(std::vector<std::string> options) const {
        options.insert(options.begin(), {"pick", "mirror.json"});
        return run(options, {.directory = directory.path});
    }
};

} // namespace

TEST_CASE("the tree of a pixel as text") {
    const Outcome outcome = Picked()({"4", "4"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out == "pixel (4, 4) of 9x9: 0.875 1.375 1.4375\n"
                         "camera ray, level 0\n"
                         "  from      1000 0 20 towards 0 0 -1\n"
                         "  hit       object 1 \"mirror\", sphere\n"
                         "  distance  16, from outside\n"
                         "  point     1000 0 4\n"
                         "  normal    0 0 1\n"
                         "  light 0   ambient: 0.25 0.125 0.0625\n"
                         "  light 1   directional: behind the surface or outside its cone\n"
                         "  light 2   directional: 0.5 1 1, visibility 1 1 1\n"
                         "  reflects  0.5 0.5 0.5\n"
                         "  color     0.875 1.375 1.4375\n"
                         "  reflection ray, level 1\n"
                         "    from      1000 0 4 towards 0 0 1\n"
                         "    hit       nothing: the background\n"
                         "    color     0.25 0.5 0.75\n");
}

TEST_CASE("switches count, and what is not traced is said") {
    const Picked pick;
    CHECK(
        contains(pick({"4", "4", "--depth", "0"}).out, "\n  reflection ray not traced, past depth or cutoff: the background\n"));
    CHECK(!contains(pick({"4", "4", "--no-reflections"}).out, "reflection"));
    CHECK(contains(pick({"0", "0"}).out, "hit       nothing: the background"));
    CHECK(contains(pick({"40", "40", "--size", "81x81"}).out, "pixel (40, 40) of 81x81: 0.875 1.375 1.4375"));
    CHECK(contains(pick({"4", "4", "--aa", "grid"}).out, ": 0.875 1.375 1.4375"));
}

TEST_CASE("the tree as JSON; triangles have their number in the mesh") {
    const std::string json = Picked()({"4", "4", "--json"}).out;
    for (const char* text : {"\"pixel\": [4, 4]", "\"color\": [0.875, 1.375, 1.4375]", "\"kind\": \"camera\"", "\"object\": 1",
                             "\"name\": \"mirror\"", "\"distance\": 16,", "\"point\": [1000, 0, 4]", "\"light\": 2",
                             "\"kind\": \"reflection\"", "\"object\": null"}) {
        CAPTURE(text);
        CHECK(contains(json, text));
    }
    // The pyramid's front is the first triangle of object 4.
    const std::string pyramid = run({"pick", small_scene().string(), "33", "18", "--quiet"}).out;
    CAPTURE(pyramid);
    CHECK(contains(pyramid, "object 4, mesh, triangle 0\n"));
}
