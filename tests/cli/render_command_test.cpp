// lanecast render: files, names, crops, switches.
#include "cli/run_program.hpp"
#include "render/exr_io.hpp"
#include "render/output_support.hpp"
#include "render/read_picture.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lanecast;
using namespace lanecast::test;

namespace {

const std::string small = small_scene().string();

std::vector<std::string> sorted_names(const std::filesystem::path& directory) {
    std::vector<std::string> names = names_in(directory);
    std::ranges::sort(names);
    return names;
}

/// The film of a scene with some options.
Film rendered(const std::filesystem::path& scene, std::vector<std::string> options) {
    const TemporaryDirectory directory;
    options.insert(options.begin(), {"render", scene.string(), "-o", "a.exr", "--float", "--quiet"});
    const Outcome outcome = run(options, {.directory = directory.path});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return read_exr(directory.path / "a.exr");
}

bool same(const Film& a, const Film& b) { return a.width == b.width && a.height == b.height && a.rgb == b.rgb; }

/// The small scene with a render block.
struct SceneWith {
    TemporaryDirectory directory;
    std::filesystem::path path = directory.path / "scene.json";
    explicit SceneWith(const std::string& block) {
        std::string text = content_of(small_scene());
        put(path, text.insert(text.find('{') + 1, "\n  \"render\": {" + block + "},"));
    }
};

} // namespace

TEST_CASE("names: the scene's by default, both files for a bare name, one for a name with an ending") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    REQUIRE(run({"render", small}, there).code == 0);
    CHECK(sorted_names(directory.path) == std::vector<std::string>{"small.exr", "small.png"});
    REQUIRE(run({"render", small, "-o", "one.exr"}, there).code == 0);
    REQUIRE(run({"render", small, "--output", "two.PNG"}, there).code == 0);
    std::filesystem::create_directory(directory.path / "sub");
    REQUIRE(run({"render", small, "-o", "sub/v1.5"}, there).code == 0);
    REQUIRE(run({"render", small, "-o", "sub/"}, there).code == 0);
    REQUIRE(run({"render", small, "-o", "sub/.png"}, there).code == 0);
    CHECK(sorted_names(directory.path) == std::vector<std::string>{"one.exr", "small.exr", "small.png", "sub", "two.PNG"});
    CHECK(sorted_names(directory.path / "sub") ==
          std::vector<std::string>{".png", "small.exr", "small.png", "v1.5.exr", "v1.5.png"});
    CHECK(picture_kind(directory.path / "one.exr") == PictureKind::exr);
    CHECK(picture_kind(directory.path / "two.PNG") == PictureKind::png);
    const Film film = read_picture(directory.path / "small.exr");
    CHECK(film.image_width == 64);
    CHECK(film.image_height == 48);
}

TEST_CASE("whole files are the same bytes for any threads, tile and run without volatile metadata, and differ with it") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    REQUIRE(run({"render", small, "-o", "a", "--no-volatile-metadata"}, there).code == 0);
    REQUIRE(run({"render", small, "-o", "b", "--no-volatile-metadata", "--threads", "3", "--tile", "7", "--isa", "scalar"}, there)
                .code == 0);
    CHECK(content_of(directory.path / "a.exr") == content_of(directory.path / "b.exr"));
    CHECK(content_of(directory.path / "a.png") == content_of(directory.path / "b.png"));
    REQUIRE(run({"render", small, "-o", "c", "--isa", "scalar"}, there).code == 0);
    const std::string with = content_of(directory.path / "c.exr"), without = content_of(directory.path / "a.exr");
    for (const char* name : {"lanecast:isa", "lanecast:threads", "lanecast:renderSeconds", "lanecast:shadowRays", "lanecast:host",
                             "lanecast:date"}) {
        CAPTURE(name);
        CHECK(contains(with, name));
        CHECK(!contains(without, name));
    }
    for (const char* text :
         {"lanecast:scene", "small.json", "lanecast:version", "lanecast:settings", "\"shadows\": true", "chromaticities"}) {
        CAPTURE(text);
        CHECK(contains(without, text));
    }
}

TEST_CASE("a crop has the pixels of the whole, in both files, with any anti-aliasing") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    for (const char* aa : {"off", "cross", "grid", "edge"}) {
        CAPTURE(aa);
        REQUIRE(run({"render", small, "-o", "whole", "--aa", aa, "--aa-samples", "2"}, there).code == 0);
        REQUIRE(run({"render", small, "-o", "part", "--aa", aa, "--aa-samples", "2", "--crop", "13,5,50,41"}, there).code == 0);
        for (const char* ending : {".exr", ".png"}) {
            CAPTURE(ending);
            const Film whole = read_picture(directory.path / (std::string("whole") + ending));
            const Film part = read_picture(directory.path / (std::string("part") + ending));
            CHECK(part.width == 37);
            CHECK(part.height == 36);
            if (ending == std::string(".exr")) {
                CHECK(part.x0 == 13);
                CHECK(part.y0 == 5);
                CHECK(part.image_width == 64);
            }
            int different = 0;
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 37; ++x)
                    for (std::size_t c = 0; c < 3; ++c)
                        different += !same_bits(part.rgb[c][static_cast<std::size_t>(y * 37 + x)],
                                                whole.rgb[c][static_cast<std::size_t>((y + 5) * 64 + x + 13)]);
            CHECK(different == 0);
        }
    }
}

TEST_CASE("every switch changes the picture, the same from scene and command line, and the command line wins") {
    struct Case {
        std::string block;                // in the scene
        std::vector<std::string> options; // the same
        std::vector<std::string> undo;    // back to the base
        std::vector<std::string> base{};  // on both sides
        bool visible = true;
    };
    const std::vector<Case> cases = {
        {R"("ambient": false)", {"--no-ambient"}, {"--ambient"}},
        {R"("diffuse": false)", {"--no-diffuse"}, {"--diffuse"}},
        {R"("specular": false)", {"--no-specular"}, {"--specular"}},
        {R"("shadows": false)", {"--no-shadows"}, {"--shadows"}},
        {R"("transmissive_shadows": true)", {"--transmissive-shadows"}, {"--no-transmissive-shadows"}},
        {R"("reflections": false)", {"--no-reflections"}, {"--reflections"}},
        {R"("transmission": false)", {"--no-transmission"}, {"--transmission"}},
        {R"("refraction": false)", {"--no-refraction"}, {"--refraction"}},
        {R"("schlick": true)", {"--schlick"}, {"--no-schlick"}},
        {R"("planes": false)", {"--no-planes"}, {"--planes"}},
        {R"("bvh": false)", {"--no-bvh"}, {"--bvh"}, {}, false},
        {R"("bvh": "off")", {"--bvh", "off"}, {"--bvh", "default"}, {}, false},
        {R"("bvh": "quality")", {"--bvh", "quality"}, {"--bvh"}, {}, false},
        {R"("depth": 1)", {"--depth", "1"}, {"--depth", "8"}},
        {R"("cutoff": 0.5)", {"--cutoff", "0.5"}, {"--cutoff", "0"}},
        {R"("soft_shadows": 4)", {"--soft-shadows", "4"}, {"--soft-shadows", "0"}},
        {R"("precision": "reference")", {"--precision", "reference"}, {"--precision", "balanced"}},
        {R"("anti_aliasing": {"mode": "cross"})", {"--aa", "cross"}, {"--anti-aliasing", "off"}},
        {R"("anti_aliasing": {"mode": "edge"})", {"--aa", "edge"}, {"--aa", "off"}},
        {R"("anti_aliasing": {"mode": "grid", "samples": 2})", {"--aa-samples", "2"}, {"--aa-samples", "4"}, {"--aa", "grid"}},
        {R"("anti_aliasing": {"mode": "cross", "offset": 1.25})",
         {"--aa-offset", "1.25"},
         {"--aa-offset", "0.3333333333333333"},
         {"--aa", "cross"}},
        {R"("anti_aliasing": {"mode": "cross", "planes": false})", {"--no-aa-planes"}, {"--aa-planes"}, {"--aa", "cross"}},
    };
    const auto joined = [](std::vector<std::string> a, const std::vector<std::string>& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    };
    for (const Case& one : cases) {
        CAPTURE(one.block);
        const SceneWith scene(one.block);
        const Film base = rendered(small, one.base), switched = rendered(small, joined(one.base, one.options));
        CHECK(same(base, switched) == !one.visible);
        CHECK(same(switched, rendered(scene.path, {})));
        CHECK(same(base, rendered(scene.path, joined(one.base, one.undo))));
        CHECK(same(base, rendered(small, joined(joined(one.base, one.options), one.undo)))); // the last one counts
    }
}

TEST_CASE("without any light and any ray but the first, things are black before the background") {
    const Film film = rendered(small, {"--no-ambient", "--no-diffuse", "--no-specular", "--no-reflections", "--no-transmission"});
    int black = 0, background = 0;
    for (std::size_t i = 0; i < film.rgb[0].size(); ++i) {
        black += film.rgb[0][i] == 0.0f && film.rgb[1][i] == 0.0f && film.rgb[2][i] == 0.0f;
        background += film.rgb[0][i] == 0.2f && film.rgb[1][i] == 0.3f && film.rgb[2][i] == 0.4f;
    }
    CHECK(black > 500);
    CHECK(background > 500);
    CHECK(black + background == 64 * 48);
}

TEST_CASE("views and exposure change the PNG alone") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    const auto content = [&](const std::vector<std::string>& options, const char* ending) {
        std::vector<std::string> arguments{"render", small, "-o", "a", "--no-volatile-metadata"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        REQUIRE(run(arguments, there).code == 0);
        return content_of(directory.path / (std::string("a") + ending));
    };
    const std::string exr = content({}, ".exr"), png = content({}, ".png");
    CHECK(content({"--view", "srgb"}, ".png") == png);
    CHECK(content({"--exposure", "0"}, ".png") == png);
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"--view", "plain"}, {"--view", "reinhard"}, {"--view", "aces"}, {"--view", "neutral"}, {"--exposure", "-1"}}) {
        CHECK(content(options, ".png") != png);
        CHECK(content(options, ".exr") == exr);
    }
}

TEST_CASE("--stats: on the standard output, with every stage and kind of ray, and the CPUs it may use") {
    const TemporaryDirectory directory;
    const Outcome outcome =
        run({"render", small, "--stats", "--aa", "cross", "--isa", "scalar"}, {.directory = directory.path, .one_cpu = true});
    CHECK(outcome.code == 0);
    for (const char* text : {"kernels        scalar, balanced, 1 ray per vector\n", "threads        1\n", "  load ", "  bake ",
                             "  build ", "  frame ", "  write ", "trace primary", "trace offset", "trace shadow",
                             "trace reflection", "trace refraction", "shade, rest", "  primary              3072 ", "  all ",
                             "tree           1 node, 4 leaves, 1 level, SAH cost ", "peak "}) {
        CAPTURE(text);
        CHECK(contains(outcome.out, text));
    }
}
