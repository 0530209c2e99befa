// lanecast selftest: what it prints, keeps and refuses.

#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include <doctest/doctest.h>

using namespace lanecast::test;

namespace {

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("a row per case with rays, failures, worst, time and target; JSON; a state that is gone on from") {
    const TemporaryDirectory directory;
    const std::vector<std::string> arguments{"selftest", "--only", "N21,N12",  "--rays",   "20000", "--isa",
                                             "scalar",   "--json", "out.json", "--resume", "state"};
    const Outcome first = run(arguments, {.directory = directory.path});
    CHECK(first.code == 0);
    for (const char* const word : {"rays", "failures", "worst", "target", "time", "N12 triangles", "N12 needles", "N21", "met"})
        CHECK_MESSAGE(has(first.out, word), word);
    CHECK(!has(first.out, "N1 edges"));
    CHECK(has(contents(directory.path / "out.json"), "\"verdict\": \"met\""));
    const Outcome second = run(arguments, {.directory = directory.path});
    CHECK(second.code == 0);
    CHECK(second.out == first.out); // times too: nothing is run again
    std::vector<std::string> other = arguments;
    other[4] = "10000";
    const Outcome refused = run(other, {.directory = directory.path});
    CHECK(refused.code == 2);
    CHECK(has(refused.err, "another run"));
}

TEST_CASE("the cases are listed; what does not exist is refused") {
    const Outcome list = run({"selftest", "--list"});
    CHECK(list.code == 0);
    for (int id = 1; id <= 23; ++id) CHECK(has(list.out, "N" + std::to_string(id) + " ") == (id != 22)); // there is no N22
    CHECK(run({"selftest", "--only", "N22"}).code == 2);
    CHECK(run({"selftest", "--isa", "neon"}).code == 2);
    CHECK(run({"selftest", "--isa", "auto", "--precision", "balanced", "--only", "N1", "--rays", "1000"}).code == 0);
    CHECK(run({"selftest", "--precision", "exact"}).code == 2);
    CHECK(run({"selftest", "--isa", "sse4.2", "--precision", "fast"}).code != 0);
    CHECK(run({"selftest", "--only", "N21", "--rays", "100", "--json", "/nowhere/out.json"}).code == 5);
}

TEST_CASE("a target that is missed is exit code 1") {
    const Outcome outcome = run({"selftest", "--only", "N10", "--rays", "60000", "--isa", "scalar"});
    // of spheres off the centre: docs/extremes.md
    CHECK(outcome.code == (has(outcome.out, "MISSED") ? 1 : 0));
    CHECK(has(outcome.out, outcome.code == 0 ? "every target is met" : "A TARGET IS MISSED"));
}

TEST_CASE("Ctrl-C ends it at once, and its state is kept") {
    const TemporaryDirectory directory;
    const std::vector<std::string> arguments{"selftest", "--only", "N3", "--rays", "1e9", "--resume", "state"};
    std::vector<std::string> slow = arguments;
    // the first saving comes after five seconds at the latest, or at the signal
    const Outcome outcome = run(slow, {.directory = directory.path, .signal_at = "started", .seconds = 60});
    CHECK(outcome.code == 130);
    CHECK(has(outcome.err, "--resume state"));
    CHECK(has(contents(directory.path / "state"), "lanecast selftest state"));
}

#ifndef LANECAST_SANITIZED // neither Embree nor its threads are built for sanitizers
TEST_CASE("beside a peer: a column each, and nobody is judged") {
    const TemporaryDirectory directory;
    const std::vector<std::string> arguments{"selftest", "--peer", "embree", "--only",  "N2,N3,N10",
                                             "--rays",   "60000",  "--json", "out.json"};
    const Outcome outcome = run(arguments, {.directory = directory.path, .seconds = 120});
    if (outcome.code == 7) { // a build without Embree or vectors
        CHECK(has(outcome.err, "--peer: "));
        return;
    }
    CHECK(outcome.code == 0);
    for (const char* const word : {"| Lanecast balanced |", " default |", " robust |", "| N2 vertices |", "| N10 far |"})
        CHECK_MESSAGE(has(outcome.out, word), word);
    CHECK(!has(outcome.out, "MISSED"));
    const std::string json = contents(directory.path / "out.json");
    CHECK(has(json, "\"name\": \"Lanecast balanced\""));
    CHECK(has(json, "\"name\": \"Embree "));
    // N3: a peer that got another scene, or whose hits were called other objects, would be wrong about many rays
    const std::size_t row = outcome.out.find("| N3 streams |");
    std::vector<std::string> cells;
    std::istringstream line(outcome.out.substr(row, outcome.out.find('\n', row) - row));
    for (std::string cell; std::getline(line, cell, '|');) cells.push_back(cell);
    REQUIRE(cells.size() >= 7); // one of ours at least
    for (std::size_t i = 4; i < cells.size(); ++i) CHECK_MESSAGE(std::stod(cells[i]) < 2e-4, cells[i]);
}
#endif

TEST_CASE("a peer that is not there, and what is not compared with one") {
    const TemporaryDirectory directory;
    const std::filesystem::path lone = directory.path / "lanecast"; // the module is looked for beside the program
    std::filesystem::copy_file(LANECAST_PROGRAM_FILE, lone);
    const Outcome outcome = run({"selftest", "--peer", "embree", "--only", "N2"}, {.program = lone});
    CHECK(outcome.code == 7);
    CHECK(has(outcome.err, "this build has no Embree"));
    CHECK(outcome.out.empty());
    CHECK(run({"selftest", "--peer", "teapot"}).code == 2);
    CHECK(run({"selftest", "--peer", "embree", "--resume", "state"}).code == 2);
    CHECK(run({"selftest", "--peer", "embree", "--isa", "scalar,avx2"}).code == 2);
    CHECK(run({"selftest", "--peer", "embree", "--isa", "scalar"}).code == 7); // Embree has none
    const Outcome list = run({"selftest", "--peer", "embree", "--list"});
    CHECK(list.code == 0);
    CHECK(has(list.out, "N8 streams"));
    CHECK(!has(list.out, "N1 edges"));
}
