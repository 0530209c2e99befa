// lanecast measure: what it writes, and what it refuses.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

using namespace lanecast::test;

namespace {

const std::string small = small_scene().string();

std::vector<std::string> quick(std::vector<std::string> more) {
    more.insert(more.begin(),
                {"measure", small, "--tiles", "2", "--repetitions", "1", "--reference-samples", "4", "--rays", "2000"});
    return more;
}

std::size_t lines_with(const std::string& text, const std::string& start) {
    std::size_t count = 0;
    for (std::size_t at = text.find("\n" + start); at != std::string::npos; at = text.find("\n" + start, at + 1)) ++count;
    return count;
}

} // namespace

TEST_CASE("tables, JSON, page and plots say the same") {
    const TemporaryDirectory directory;
    const Outcome outcome = run(quick({"--json", "m.json", "--html", "m.html", "--plot", "m.svg,m.png"}),
                                {.directory = directory.path, .seconds = 900});
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(content_of(directory.path / "m.json"));
    CHECK(json["scene"] == "small.json");
    CHECK(json["width"] == 64);
    CHECK(json["whole_frame"] == false);
    CHECK(json["tiles"] == 2);
    CHECK(json["share_of_pixels"] > 0.3); // of two rows of two tiles, the lower ones half as high
    CHECK(json["share_of_pixels"] < 0.7);
    const auto& trials = json["trials"];
    CHECK(trials.size() > 30);
    std::size_t knob_lines = 0;
    for (const char* knob : {"precision", "anti-aliasing", "soft shadows", "depth", "cutoff", "file"}) {
        const auto rows =
            std::count_if(json["knobs"].begin(), json["knobs"].end(), [&](const auto& row) { return row["knob"] == knob; });
        CHECK(rows >= 2);
        const std::size_t head = knob == std::string("precision") ? 1 : 0; // of the table of rays
        CHECK(lines_with(outcome.out, std::string(knob) + "  ") == static_cast<std::size_t>(rows) + head);
        knob_lines += static_cast<std::size_t>(rows);
    }
    CHECK(knob_lines == json["knobs"].size());
    std::size_t on_front = 0;
    double before = 1e300;
    for (const auto& trial : trials) on_front += trial["on_front"] ? 1 : 0;
    CHECK(on_front == json["front"].size());
    const std::string html = content_of(directory.path / "m.html"), svg = content_of(directory.path / "m.svg");
    for (const auto& index : json["front"]) {
        const auto& trial = trials[index.get<std::size_t>()];
        CHECK(trial["error"]["rmse"] < before);
        before = trial["error"]["rmse"];
        CHECK(contains(outcome.out, trial["choice"].get<std::string>()));
        CHECK(contains(html, trial["choice"].get<std::string>()));
        char text[32];
        std::snprintf(text, sizeof text, before != 0 && before < 1e-3 ? "%.2e" : "%.3g", before);
        CHECK(contains(outcome.out, text));
        CHECK(contains(html, text));
        // what was measured can be rendered again by its settings
        CHECK(nlohmann::json::parse(trial["settings"].get<std::string>()).contains("anti_aliasing"));
    }
    CHECK(json["rays"].size() >= 4);
    CHECK(svg.starts_with("<svg"));
    CHECK(contains(html, svg.substr(0, 200)));
    CHECK(!contains(html, "http://www.w3.org/1999"));
    CHECK(!contains(html, "src="));
    CHECK(content_of(directory.path / "m.png").starts_with("\x89PNG"));
    CHECK(contains(outcome.err, "lanecast measure: "));
}

TEST_CASE("knobs set by hand are not turned") {
    const Outcome outcome = run(
        quick({"--quiet", "--aa", "off", "--soft-shadows", "0", "--cutoff", "0.1", "--precision", "balanced"}), {.seconds = 900});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(lines_with(outcome.out, "depth  ") > 5);
    for (const char* knob : {"anti-aliasing  ", "soft shadows  ", "cutoff  "}) CHECK(lines_with(outcome.out, knob) == 0);
    CHECK(contains(outcome.out, "\nreference: depth 64, float, in double;"));
    CHECK(contains(outcome.out, " On no front here: "));
}

TEST_CASE("what cannot be measured is refused in one line") {
    const auto refused = [](const std::vector<std::string>& arguments, int code) {
        const Outcome outcome = run(arguments);
        CAPTURE(outcome.err);
        CHECK(outcome.code == code);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == (contains(outcome.err, "Try 'lanecast") ? 2 : 1));
        CHECK(outcome.out.empty());
    };
    refused({"measure"}, 2);
    refused({"measure", "/nowhere/scene.json"}, 3);
    refused({"measure", small, "--isa", "neon"}, 2);
    refused({"measure", small, "--repetitions", "0"}, 2);
    refused({"measure", small, "--quick", "--tiles", "2"}, 2);
    refused({"measure", small, "--reference-samples", "1"}, 2);
    refused({"measure", small, "--reference-samples", "65"}, 2);
    refused({"measure", small, "--tiles", "2.5"}, 2);
    refused({"measure", small, "--rays", "many"}, 2);
    refused({"measure", small, "--plot", "plot.jpg"}, 2);
    refused({"measure", small, "--json", "/nowhere/m.json"}, 5);
    refused({"measure", small, "--html", "/nowhere/m.html"}, 5);
    refused({"measure", small, "--plot", "/nowhere/m.svg"}, 5);
}

TEST_CASE("--quick samples the frame by what its reference costs, and says what it sampled") {
    const Outcome outcome = run({"measure", small, "--quick", "--size", "4096x4096", "--threads", "1", "--aa", "grid",
                                 "--aa-samples", "4", "--precision", "balanced", "--repetitions", "1", "--rays", "2000"},
                                {.seconds = 600});
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, " % of the frame's pixels"));
    CHECK(contains(outcome.err, " % of the frame's pixels"));
}

TEST_CASE("interrupted in the middle of a picture in double, it ends at once and leaves the old files") {
    const TemporaryDirectory directory;
    put(directory.path / "m.json", "old");
    const Outcome outcome = run({"measure", small, "--size", "2048x2048", "--json", "m.json"},
                                {.directory = directory.path, .signal_at = "the reference"});
    CHECK(outcome.code == 130);
    CHECK(outcome.out.empty());
    CHECK(content_of(directory.path / "m.json") == "old");
    CHECK(names_in(directory.path).size() == 1);
}
