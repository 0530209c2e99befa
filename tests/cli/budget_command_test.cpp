// lanecast render --max-error and --max-time: what is refused, what is recorded, that a bound holds.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

using namespace lanecast::test;

namespace {

const std::string small = small_scene().string();

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// What follows `from`, up to one of `until`.
std::string between(const std::string& text, const std::string& from, const std::string& until) {
    const std::size_t begin = text.find(from);
    REQUIRE(begin != std::string::npos);
    const std::size_t start = begin + from.size();
    return text.substr(start, text.find_first_of(until, start) - start);
}

Outcome render(const std::filesystem::path& directory, const std::string& scene, const std::string& name,
               const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", scene, "--size", "16x12", "-o", name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, {.directory = directory, .seconds = 900});
}

} // namespace

TEST_CASE("budgets that make no sense are usage errors, before anything is tried") {
    const TemporaryDirectory directory;
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--max-error", "0"},
                                               {"--max-error", "-0.1"},
                                               {"--max-error", "nan"},
                                               {"--max-error", "small"},
                                               {"--max-error"},
                                               {"--max-time", "0"},
                                               {"--max-time", "-1"},
                                               {"--max-time", "1s"},
                                               {"--error-metric", "rmse"},
                                               {"--max-error", "0.1", "--error-metric", "psnr"},
                                               {"--max-time", "1", "--error-metric", "max"},
                                               {"--max-error", "0.1", "--max-time", "1"}}) {
        const Outcome outcome = render(directory.path, small, "a", options);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, "--"));
        CHECK(contains(outcome.err, "Try 'lanecast render --help'."));
        CHECK(names_in(directory.path).empty());
    }
}

TEST_CASE("what was picked is recorded in both files, and gives the same bytes as options and as a scene's settings") {
    for (const std::vector<std::string>& budget :
         std::vector<std::vector<std::string>>{{"--max-error", "0.03"},
                                               {"--max-error", "0.02", "--error-metric", "flip"},
                                               {"--max-error", "0.5", "--error-metric", "max"},
                                               {"--max-time", "0.05"}}) {
        CAPTURE(budget[0] + " " + budget[1]);
        const TemporaryDirectory directory;
        const Outcome picked = render(directory.path, small, "picked", budget);
        CAPTURE(picked.err);
        REQUIRE(picked.code == 0);
        const std::string options = between(picked.err, "the same again: ", "\n");
        const std::string exr = content_of(directory.path / "picked.exr"), png = content_of(directory.path / "picked.png");
        for (const std::string& file : {exr, png}) {
            CHECK(contains(file, "lanecast:budget"));
            CHECK(contains(file, budget[0].substr(2) + " " + budget[1]));
            CHECK(contains(file, options));
        }
        const std::size_t at = png.find("lanecast:settings") + 18; // and a 0
        const std::string settings = png.substr(at, png.find("\"}", png.find("\"precision\"", at)) + 2 - at);
        CHECK(contains(exr, settings));
        std::string scene = content_of(small_scene());
        put(directory.path / "scene.json", scene.insert(scene.find('{') + 1, "\n  \"render\": " + settings + ","));

        std::vector<std::string> by_scene{"-q"};
        if (contains(options, "--float")) by_scene.push_back("--float");
        REQUIRE(render(directory.path, small, "hand", words_of(options)).code == 0);
        REQUIRE(render(directory.path, "scene.json", "scene", by_scene).code == 0);
        for (const char* same : {"hand", "scene"}) // every bit
            for (const char* ending : {".exr", ".png"})
                CHECK(run({"diff", std::string(same) + ending, std::string("picked") + ending}, {.directory = directory.path})
                          .code == 0);
        CHECK(!contains(content_of(directory.path / "hand.exr"), "lanecast:budget"));
        CHECK(!contains(content_of(directory.path / "hand.png"), "lanecast:budget"));
    }
}

TEST_CASE("whole files are the same bytes without volatile metadata") {
    for (const char* bound : {"0.1", "0.02"}) {
        const TemporaryDirectory directory;
        const Outcome picked = render(directory.path, small, "a", {"--max-error", bound, "--no-volatile-metadata"});
        CAPTURE(picked.err);
        REQUIRE(picked.code == 0);
        std::vector<std::string> options = words_of(between(picked.err, "the same again: ", "\n"));
        options.push_back("--no-volatile-metadata");
        REQUIRE(render(directory.path, small, "b", options).code == 0);
        CHECK(content_of(directory.path / "a.exr") == content_of(directory.path / "b.exr"));
        CHECK(content_of(directory.path / "a.png") == content_of(directory.path / "b.png"));
    }
}

TEST_CASE("the bound holds on the frame, against the reference that the program names") {
    for (const auto& [metric, limit, bound] :
         {std::tuple{"rmse", "--max-rmse", "0.03"}, {"rmse", "--max-rmse", "0.006"}, {"max", "--max-error", "0.4"}}) {
        CAPTURE(metric);
        CAPTURE(bound);
        const TemporaryDirectory directory;
        const Outcome picked = render(directory.path, small, "picked.exr", {"--max-error", bound, "--error-metric", metric});
        CAPTURE(picked.err);
        REQUIRE(picked.code == 0);
        std::vector<std::string> reference = words_of(between(picked.err, "reference: ", ";"));
        CHECK(reference[1] == "reference");
        reference.push_back("-q");
        REQUIRE(render(directory.path, small, "reference.exr", reference).code == 0);
        const Outcome diff = run({"diff", "picked.exr", "reference.exr", limit, bound}, {.directory = directory.path});
        CAPTURE(diff.out);
        CHECK(diff.code == 0);
    }
}

TEST_CASE("where only the reference's samples keep a bound, its other knobs are still turned down") {
    const TemporaryDirectory directory;
    const auto rays_of = [](const Outcome& outcome) { // "wrote a.exr (16x12, 1.23 M rays in 4 ms)"
        const std::vector<std::string> words = words_of(between(outcome.err, "wrote ", "\n"));
        const double rays = std::stod(words[2]);
        return words[3] == "M" ? 1e6 * rays : words[3] == "k" ? 1e3 * rays : rays;
    };
    const Outcome picked = render(directory.path, small, "picked.exr", {"--max-error", "0.03", "--error-metric", "max"});
    CAPTURE(picked.err);
    REQUIRE(picked.code == 0);
    const Outcome reference = render(directory.path, small, "truth.exr", words_of(between(picked.err, "reference: ", ";")));
    CAPTURE(reference.err);
    REQUIRE(reference.code == 0);
    CHECK(rays_of(picked) < rays_of(reference) / 4);
    CHECK(run({"diff", "picked.exr", "truth.exr", "--max-error", "0.03"}, {.directory = directory.path}).code == 0);
}

TEST_CASE("the bound holds where all there is lies between the tiles that are tried") {
    const TemporaryDirectory directory;
    const auto render = [&](const char* name, std::vector<std::string> options) {
        options.insert(options.begin(), {"render", "scene.json", "--size", "384x384", "-o", name});
        return run(options, {.directory = directory.path, .seconds = 900});
    };
    // a frame of 24x24 units and as many tiles, a mirror the size of one of them
    const auto put_scene = [&](const char* position) {
        put(directory.path / "scene.json",
            R"({"camera": {"position": [0, 0, 10], "look_at": [0, 0, 0], "field": 100.388858, "background": [1, 1, 1]}, "objects": [
            {"type": "plane", "position": [0, 0, -1], "normal": [0, 0, 1], "material": {"ambient": [0.5, 0.5, 0.5]}},
            {"type": "sphere", "radius": 0.4, "position": )" +
                std::string(position) + R"(, "material": {"reflective": [1, 1, 1]}}],
            "lights": [{"type": "ambient", "color": [1, 1, 1]}]})");
    };
    for (const char* position : {"[-2.5, 7.5, 0]", "[4.5, -1.5, 0]"}) {
        CAPTURE(position);
        put_scene(position);
        REQUIRE(
            render("truth.exr", {"--precision", "balanced", "--aa", "grid", "--aa-samples", "8", "--depth", "8", "-q"}).code ==
            0);
        for (const auto& [metric, limit, bound] : {std::tuple{"rmse", "--max-rmse", "0.001"}, {"max", "--max-error", "0.25"}}) {
            CAPTURE(metric);
            const Outcome picked = render("picked.exr", {"--max-error", bound, "--error-metric", metric});
            CAPTURE(picked.err);
            REQUIRE(picked.code == 0);
            const Outcome diff = run({"diff", "picked.exr", "truth.exr", limit, bound}, {.directory = directory.path});
            CAPTURE(diff.out);
            CHECK(diff.code == 0);
        }
    }
}

TEST_CASE("a looser bound is not dearer, and knobs given by hand stay") {
    const TemporaryDirectory directory;
    const auto rays = [&](const std::string& bound) {
        const Outcome outcome = render(directory.path, small, "a.exr", {"--max-error", bound, "--stats"});
        CAPTURE(outcome.err);
        REQUIRE(outcome.code == 0);
        return std::stod(words_of(outcome.out.substr(outcome.out.find("\n  all  ")))[1]);
    };
    const double loose = rays("0.3"), tight = rays("0.005");
    CHECK(loose < tight);
    const Outcome outcome =
        render(directory.path, small, "a.exr",
               {"--max-error", "0.1", "--aa", "grid", "--aa-samples", "5", "--depth", "3", "--cutoff", "0.3"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const std::string options = between(outcome.err, "the same again: ", "\n");
    CHECK(contains(options, "--aa grid --aa-samples 5 "));
    CHECK(contains(options, "--depth 3 --cutoff 0.3"));
}

TEST_CASE("a budget that nothing keeps is told in one line with exit code 2, and nothing is written") {
    const TemporaryDirectory directory;
    put(directory.path / "a.exr", "old");
    for (const std::vector<std::string>& budget : std::vector<std::vector<std::string>>{
             {"--max-error", "1e-9"}, {"--max-error", "1e-9", "--error-metric", "flip"}, {"--max-time", "1e-9"}}) {
        std::vector<std::string> quiet = budget;
        quiet.push_back("-q");
        const Outcome outcome = render(directory.path, small, "a.exr", quiet);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(contains(outcome.err, "lanecast: error: " + budget[0] + " 1e-09: no settings "));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK(content_of(directory.path / "a.exr") == "old");
        CHECK(names_in(directory.path).size() == 1);
    }
}

TEST_CASE("interrupted while it looks for settings, it ends at once and leaves the old files") {
    const TemporaryDirectory directory;
    put(directory.path / "a.exr", "old");
    const Outcome outcome = run({"render", small, "-o", "a.exr", "--size", "4096x4096", "--max-error", "0.001"},
                                {.directory = directory.path, .signal_at = "looking for settings"});
    CHECK(outcome.code == 130);
    CHECK(content_of(directory.path / "a.exr") == "old");
    CHECK(names_in(directory.path).size() == 1);
}
