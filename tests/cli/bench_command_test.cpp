// lanecast bench: that it measures what it is asked to, and what it refuses.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

using namespace lanecast::test;

namespace {

const std::string gem = LANECAST_SOURCE_DIR "/scenes/meshes/gem.ply";

std::size_t lines_with(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("a row per kind, instruction set, precision and number of threads; JSON and plots") {
    const TemporaryDirectory directory;
    const Outcome outcome = run({"bench",         gem,
                                 "--rays",        "4096",
                                 "--repetitions", "2",
                                 "--check",       "500",
                                 "--kinds",       "primary,mirror",
                                 "--isa",         "scalar",
                                 "--precision",   "balanced,reference",
                                 "--threads",     "1,2",
                                 "--commit",      "abc",
                                 "--json",        "out.json",
                                 "--plot",        "out.svg,out.png"},
                                {.directory = directory.path});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(lines_with(outcome.out, "\nprimary ") == 4);
    CHECK(lines_with(outcome.out, "\nmirror ") == 4);
    const std::string json = contents(directory.path / "out.json");
    CHECK(lines_with(json, "\"rays_per_second\"") == 8);
    CHECK(lines_with(json, "\"against_reference\"") == 4); // for one number of threads
    for (const char* key : {"\"cpu\"", "\"compiler\"", "\"commit\": \"abc\"", "repetitions=2"}) {
        CAPTURE(key);
        CHECK(json.find(key) != std::string::npos);
    }
    CHECK(contents(directory.path / "out.svg").starts_with("<svg"));
    CHECK(contents(directory.path / "out.png").starts_with("\x89PNG"));
}

TEST_CASE("frames and calls") {
    const Outcome frames =
        run({"bench", "--frames", LANECAST_SOURCE_DIR "/scenes/empty.json", "--repetitions", "1"}, {.seconds = 120});
    CHECK(frames.code == 0);
    CHECK(frames.out.find("outside traversal") != std::string::npos);
    CHECK(frames.out.find("speed-up of a pair") != std::string::npos);
    const Outcome calls = run({"bench", gem, "--calls", "--isa", "scalar", "--repetitions", "1"}, {.seconds = 120});
    CHECK(calls.code == 0);
    CHECK(calls.out.find("nanoseconds per ray") != std::string::npos);
}

TEST_CASE("what a scene leaves out: a row per feature, and the same pixels with each of them") {
#ifdef LANECAST_SANITIZED
    const std::string width = "18", height = "12";
#else
    const std::string width = "96", height = "64";
#endif
    const TemporaryDirectory directory;
    const auto features = [&](const std::string& scene, const std::string& isa) {
        const Outcome outcome =
            run({"bench", "--features", LANECAST_SOURCE_DIR "/scenes/" + scene + ".json", "--size", width + "x" + height, "--isa",
                 isa, "--repetitions", "2", "--commit", "abc", "--json", "out.json"},
                {.directory = directory.path, .seconds = 300});
        CHECK(outcome.code == 0); // not if a pixel differed
        CHECK(outcome.err.empty());
        return outcome.out;
    };
    for (const char* const isa : {"scalar", "auto"}) {
        const std::string sphere = features("sphere", isa);
        for (const char* feature : {"soft shadows", "transmissive shadows", "reflection", "transmission", "all of these"}) {
            CAPTURE(feature);
            CHECK(lines_with(sphere, std::string("\n") + feature + " ") == 1);
        }
        const std::string json = contents(directory.path / "out.json");
        CHECK(lines_with(json, "\"gain\"") == lines_with(sphere, " to "));
        CHECK(lines_with(json, "\"differing_pixels\": 0") == lines_with(json, "\"gain\""));
        for (const std::string& key : {std::string("\"cpu\""), std::string("\"commit\": \"abc\""), "\"width\": " + width})
            CHECK(json.find(key) != std::string::npos);
    }
    const std::string glass = features("refraction", "auto");
    for (const char* feature : {"transmission", "transmissive shadows"})
        CHECK(lines_with(glass, std::string("\n") + feature + " ") == 0);
    CHECK(lines_with(features("reflection", "auto"), "\ncut-off ") == 1);
    CHECK(lines_with(features("soft_shadows", "auto"), "\nsoft shadows ") == 0);
}

TEST_CASE("building trees: a line per size, tree and number of threads") {
    const Outcome outcome = run({"bench", "terrain", "--builds", "--triangles", "200,5000", "--bvh", "default,quality",
                                 "--threads", "1,2", "--isa", "scalar", "--repetitions", "2"},
                                {.seconds = 120});
    CHECK(outcome.code == 0);
    CHECK(lines_with(outcome.out, "B/tri") >= 1);
    CHECK(lines_with(outcome.out, "\nterrain                200 ") == 4);
    CHECK(lines_with(outcome.out, "\nterrain               5000 ") == 4);
}

TEST_CASE("what cannot be measured is refused") {
    CHECK(run({"bench"}).code == 2);
    CHECK(run({"bench", "teapot"}).code == 2);
    CHECK(run({"bench", "/nowhere/mesh.ply"}).code == 4);
    CHECK(run({"bench", "--features", "/nowhere/scene.json"}).code == 3);
    CHECK(run({"bench", "--features", "a.json", "--frames", "a.json"}).code == 2);
    CHECK(run({"bench", "--features", "a.json", "--size", "0x1"}).code == 2);
    CHECK(run({"bench", gem, "--isa", "neon"}).code == 2);
    CHECK(run({"bench", gem, "--builds", "--isa", "neon"}).code == 2);
    CHECK(run({"bench", gem, "--builds", "--triangles", "1"}).code == 2);
    CHECK(run({"bench", gem, "--kinds", "gamma"}).code == 2);
    CHECK(run({"bench", gem, "--repetitions", "0"}).code == 2);
    CHECK(run({"bench", gem, "--threads", "0"}).code == 2);
    CHECK(run({"bench", gem, "--rays", "0"}).code == 2);
    CHECK(run({"bench", gem, "--rays", "1024", "--repetitions", "1", "--isa", "scalar", "--json", "/nowhere/out.json"}).code ==
          5);
}
