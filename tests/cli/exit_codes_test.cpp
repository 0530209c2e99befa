// Each exit code, from the real program.
#include "cli/run_program.hpp"
#include "render/dispatch.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <thread>

#include <sys/stat.h>
#include <unistd.h>

using namespace lanecast::test;

namespace {

int lines_of(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

const std::string small = small_scene().string();

} // namespace

TEST_CASE("0: help, version, and every command's help lists the exit codes") {
    Outcome outcome = run({"--version"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.starts_with("lanecast "));
    CHECK(outcome.err.empty());
    outcome = run({"--help"});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "130  interrupted"));
    for (const char* command : {"render", "check", "info", "pick", "diff", "bench", "measure", "schema"}) {
        CAPTURE(command);
        CHECK(contains(outcome.out, command));
        const Outcome help = run({command, "--help"});
        CHECK(help.code == 0);
        CHECK(help.err.empty());
        CHECK(contains(help.out, std::string("lanecast ") + command));
        CHECK(contains(help.out, "Exit codes:"));
        CHECK(!contains(help.out, "{false}"));
    }
    CHECK(run({"schema"}).out == content_of(std::filesystem::path(LANECAST_SOURCE_DIR) / "scenes/scene.schema.json"));
}

TEST_CASE("1: a comparison found a difference") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    REQUIRE(run({"render", small, "-o", "a.png"}, there).code == 0);
    REQUIRE(run({"render", small, "-o", "b.png", "--no-shadows"}, there).code == 0);
    CHECK(run({"diff", "a.png", "a.png"}, there).code == 0);
    const Outcome outcome = run({"diff", "a.png", "b.png"}, there);
    CHECK(outcome.code == 1);
    CHECK(contains(outcome.out, "result              different"));
    CHECK(run({"diff", "a.png", "b.png", "--max-rmse", "1"}, there).code == 0);
    CHECK(run({"diff", "a.png", "b.png", "--max-rmse", "1", "--max-error", "0.001"}, there).code == 1);
}

TEST_CASE("2: usage, in one line that names the option, and a line on help") {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"rendr", small},
        {"render"},
        {"render", small, "extra"},
        {"render", small, "--shadow"},
        {"render", small, "--size"},
        {"render", small, "--size", "0x0"},
        {"render", small, "--size", "64"},
        {"render", small, "--size", "64x-48"},
        {"render", small, "--size", "64x48x2"},
        {"render", small, "--size", "99999999999x1"},
        {"render", small, "--size", "65537x1"},
        {"render", small, "--size", "65536x65536"},
        {"render", small, "--crop", "0,0,1"},
        {"render", small, "--crop", "0,0,0,1"},
        {"render", small, "--crop", "-1,0,2,2"},
        {"render", small, "--crop", "0,0,65,48"}, // the image is 64 x 48
        {"render", small, "--crop", "0,0,64,49"},
        {"render", small, "--crop", "5,5,4,6"},
        {"render", small, "--threads", "0"},
        {"render", small, "--threads", "-1"},
        {"render", small, "--threads", "two"},
        {"render", small, "--tile", "65"},
        {"render", small, "--tile", "0"},
        {"render", small, "--view", "sepia"},
        {"render", small, "--exposure", "nan"},
        {"render", small, "--exposure", "1e999"},
        {"render", small, "--isa", "mmx"},
        {"render", small, "--precision", "double"},
        {"render", small, "--aa", "on"},
        {"render", small, "--aa-samples", "0"},
        {"render", small, "--aa-samples", "2.5"},
        {"render", small, "--aa-offset", "0"},
        {"render", small, "--depth", "-1"},
        {"render", small, "--depth", "1025"},
        {"render", small, "--cutoff", "1.5"},
        {"render", small, "--soft-shadows", "1e9"},
        {"pick", small, "1"},
        {"pick", small, "64", "0"},
        {"pick", small, "0", "-1"},
        {"diff", "a.exr"},
        {"diff", "a.exr", "b.exr", "--max-off-share", "2"},
        {"diff", "a.exr", "b.exr", "-o", "c.jpg"},
        {"render", small, "-o", "a.jpg"},
        {"render", small, "-o", "none/a.TIFF"},
        {"render", small, "-o", ""},
        {"render", small, "--isa", "avx2", "--precision", "reference"},
        {"pick", small, "1", "1", "--isa", "sse4.2", "--precision", "reference"},
        {"render", small, "--isa", "sse4.2", "--precision", "fast"},
        {"render", small, "--isa", "scalar", "--precision", "precise"},
    };
    const TemporaryDirectory directory;
    for (const auto& arguments : wrong) {
        std::string shown;
        for (const std::string& argument : arguments) shown += argument + " ";
        CAPTURE(shown);
        const Outcome outcome = run(arguments, {.directory = directory.path});
        CAPTURE(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(contains(outcome.err, "error: "));
        CHECK(lines_of(outcome.err) <= 2);
    }
    CHECK(names_in(directory.path).empty());
    CHECK(contains(run({"render", small, "--shadow"}).err, "did you mean '--shadows'?"));
    CHECK(contains(run({"render", small, "--no-shadow"}).err, "did you mean '--no-shadows'?"));
    CHECK(contains(run({"rendr", small}).err, "did you mean 'render'?"));
    CHECK(run({"render", small, "-o", "a.jpg"}).err ==
          "lanecast: error: --output: a.jpg: pictures are written as .exr and .png, not as .jpg\n");
    CHECK(contains(run({"render", small, "--size", "0x0"}).err, "--size: must be WIDTHxHEIGHT, each from 1 to 65536, got '0x0'"));
}

TEST_CASE("3: the scene; the message has file, line, column, place, the source line and a caret") {
    const TemporaryDirectory directory;
    put(directory.path / "bad.json",
        "{ \"camera\": {}, \"lights\": [],\n  \"objects\": [ { \"type\": \"sphere\", \"radius\": -1, "
        "\"material\": {} } ] }\n");
    for (const char* command : {"render", "check", "info"}) {
        const Outcome outcome = run({command, "bad.json"}, {.directory = directory.path});
        CHECK(outcome.code == 3);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("bad.json:2:46: error: /objects/0/radius: must be a positive number, got -1\n"));
        CHECK(lines_of(outcome.err) == 3);
    }
    CHECK(run({"pick", "bad.json", "0", "0"}, {.directory = directory.path}).code == 3);
    // What only the flattened scene shows has its place, too.
    put(directory.path / "far.json",
        "{ \"camera\": {}, \"lights\": [],\n  \"objects\": [ { \"type\": \"sphere\", \"radius\": 1e-25, "
        "\"position\": [0, 0, -1e-24], \"material\": {} },\n"
        "    { \"type\": \"sphere\", \"radius\": 1, \"material\": {} } ] }\n");
    for (const char* command : {"render", "check", "info"}) {
        const Outcome outcome = run({command, "far.json"}, {.directory = directory.path});
        CHECK(outcome.code == 3);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("far.json:2:16: error: /objects/0: is smaller than 2^-60 of the scene's geometry\n"));
        CHECK(lines_of(outcome.err) == 3);
    }
    const Outcome missing = run({"check", "missing.json"}, {.directory = directory.path});
    CHECK(missing.code == 3);
    CHECK(contains(missing.err, "missing.json: error: "));
    CHECK(run({"render", ""}).err == "'': error: cannot read the scene: No such file or directory\n");
    // Warnings are errors under --strict; this one is of the flattened scene.
    CHECK(run({"check", small}).code == 0);
    CHECK(run({"check", small, "--strict"}).code == 3);
    CHECK(names_in(directory.path) == std::vector<std::string>{"bad.json", "far.json"});
}

TEST_CASE("a scene may come from a pipe, in pieces and late; nobody waits for ever for one without a writer, nor for a mesh") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path, .seconds = 30};
    const auto pipe = directory.path / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const std::string text = content_of(small_scene());
    {
        const std::jthread writer([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            std::ofstream out(pipe);
            for (const std::string& part : {text.substr(0, 100), text.substr(100)}) {
                out << part << std::flush;
                std::this_thread::sleep_for(std::chrono::milliseconds(200));
            }
        });
        const Outcome outcome = run({"check", "pipe"}, there);
        CHECK(outcome.code == 0);
        CHECK(outcome.out == "pipe: ok, 5 objects, 4 lights, 1 warning\n");
    }
    {
        const std::jthread writer([&] { const std::ofstream out(pipe); });
        CHECK(contains(run({"check", "pipe"}, there).err, "pipe:1:1: error: "));
    }
    Outcome outcome = run({"check", "pipe"}, there);
    CHECK(outcome.code == 3);
    CHECK(outcome.err == "pipe: error: cannot read the scene: No program writes to this pipe\n");
    std::filesystem::create_symlink("pipe", directory.path / "pipe.ply");
    std::filesystem::create_symlink("pipe", directory.path / "pipe.mtl");
    put(directory.path / "m.json",
        R"({"camera": {}, "lights": [], "objects": [{"type": "mesh", "file": "pipe.ply", "material": {}}]})");
    outcome = run({"check", "m.json"}, there);
    CHECK(outcome.code == 4);
    CHECK(contains(outcome.err, "cannot read pipe.ply: Not a regular file"));
    put(directory.path / "o.json",
        R"({"camera": {}, "lights": [], "objects": [{"type": "mesh", "file": "m.obj", "material": {}}]})");
    put(directory.path / "m.obj", "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    outcome = run({"check", "o.json"}, there);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "cannot read the materials `pipe.mtl`: Not a regular file"));
    CHECK(run({"diff", "pipe", "pipe"}, there).code == 4);
}

TEST_CASE("4: a mesh or a picture that cannot be read") {
    const TemporaryDirectory directory;
    put(directory.path / "m.json",
        R"({"camera": {}, "lights": [], "objects": [{"type": "mesh", "file": "none.ply", "material": {}}]})");
    CHECK(run({"check", "m.json"}, {.directory = directory.path}).code == 4);
    CHECK(run({"render", "m.json"}, {.directory = directory.path}).code == 4);
    CHECK(run({"diff", "m.json", "m.json"}, {.directory = directory.path}).code == 4);
    CHECK(run({"diff", "none.exr", "none.exr"}, {.directory = directory.path}).code == 4);
}

TEST_CASE("5: outputs that cannot be written are found before the frame, which would take hours here") {
    const TemporaryDirectory directory;
    std::vector<std::string> arguments{"render", small, "--size", "8192x8192", "--aa", "grid", "--aa-samples", "64", "-o"};
    const auto fails = [&](const std::string& name, const std::string& reason) {
        CAPTURE(name);
        arguments.push_back(name);
        const Outcome outcome = run(arguments, {.directory = directory.path});
        arguments.pop_back();
        CAPTURE(outcome.err);
        CHECK(outcome.code == 5);
        CHECK(contains(outcome.err, reason));
    };
    fails("none/a", "the directory none does not exist");
    fails("/proc/a", "/proc/a.exr: cannot write");
    std::filesystem::create_directory(directory.path / "d.png");
    fails("d", "d.png: cannot write"); // the EXR could be written, the PNG not
    fails(".", ".: is a directory; ./ puts the pictures into it");
    std::filesystem::remove(directory.path / "d.png");
    std::filesystem::create_directory(directory.path / "d");
    fails("d", "d: is a directory; d/ puts the pictures into it");
    fails("no\nsuch\033[2J/a", "no?such?[2J/a.exr: cannot write: the directory no?such?[2J does not exist\n");
    CHECK(names_in(directory.path) == std::vector<std::string>{"d"});
    if (::geteuid() == 0) return; // root may write anywhere
    std::filesystem::permissions(directory.path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    fails("a", "a.exr: cannot write: Permission denied");
    std::filesystem::permissions(directory.path, std::filesystem::perms::owner_all);
}

TEST_CASE("5: a full disk leaves the old files and nothing else, also where one of the two would have had room") {
    const TemporaryDirectory directory;
    const std::vector<std::string> arguments{"render", small, "-o", "a", "--size", "256x256"};
    const auto exr = directory.path / "a.exr", png = directory.path / "a.png";
    REQUIRE(run(arguments, {.directory = directory.path}).code == 0);
    const std::size_t exr_size = std::filesystem::file_size(exr), png_size = std::filesystem::file_size(png);
    put(exr, "old exr");
    put(png, "old png");
    for (const std::size_t bytes : {std::size_t{100}, (exr_size + png_size) / 2}) {
        const Outcome outcome = run(arguments, {.directory = directory.path, .file_size = bytes});
        CHECK(outcome.code == 5);
        CHECK(contains(outcome.err, "cannot write: File too large"));
        CHECK(content_of(exr) == "old exr");
        CHECK(content_of(png) == "old png");
        CHECK(names_in(directory.path).size() == 2);
    }
    CHECK(run(arguments, {.directory = directory.path}).code == 0);
    CHECK(std::filesystem::file_size(exr) > 100);
    CHECK(std::filesystem::file_size(png) == png_size);
    CHECK(names_in(directory.path).size() == 2);
}

TEST_CASE("5: a full standard output") {
    if (std::filesystem::exists("/dev/full")) CHECK(run({"info", small}, {.out_file = "/dev/full"}).code == 5);
}

#ifndef LANECAST_SANITIZED // sanitizers reserve more address space than there is
TEST_CASE("6: memory") {
    const TemporaryDirectory directory;
    const Outcome outcome =
        run({"render", small, "--size", "16384x16384"}, {.directory = directory.path, .address_space = std::size_t{1} << 30});
    CHECK(outcome.code == 6);
    CHECK(contains(outcome.err, "out of memory"));
    CHECK(names_in(directory.path).empty());
}
#endif

TEST_CASE("7: an instruction set that cannot be had") {
    bool found = false;
    for (const lanecast::IsaInfo& isa : lanecast::known_isas()) {
        if (isa.compiled && isa.supported) continue;
        found = true;
        const Outcome outcome = run({"render", small, "--isa", isa.name});
        CHECK(outcome.code == 7);
        CHECK(contains(outcome.err, "lanecast: error: this "));
        CHECK(contains(outcome.err, "lacks instruction set '" + isa.name + "'; it "));
    }
    if (!found) std::puts("skipped: this build and this CPU have every instruction set; qemu_nehalem tests exit code 7, too");
}

TEST_CASE("values that overflow are told of, with --quiet too, and are an error before anything is written with --strict") {
    const TemporaryDirectory directory;
    const RunOptions there{.directory = directory.path};
    put(directory.path / "bright.json",
        R"({"camera": {"background": [7e4, 0, 0], "resolution": [32, 32]}, "lights": [{"type": "ambient", "color": [1e30, 1, 1]}],
            "objects": [{"type": "sphere", "radius": 1, "position": [0, 0, -4], "material": {"ambient": [1e30, 1, 1]}}]})");
    const std::string overflow = " values of the picture overflowed; infinity became the largest number, NaN became 0\n";
    const std::string clamped = " values of the picture had to be clamped to 65504, the largest half; --float keeps them\n";
    Outcome outcome = run({"render", "bright.json", "-o", "a"}, there);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.starts_with("bright.json: warning: "));
    CHECK(contains(outcome.err, overflow));
    CHECK(contains(outcome.err, clamped));
    outcome = run({"render", "bright.json", "-o", "a", "--quiet"}, there);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, overflow));
    CHECK(!contains(outcome.err, "clamped"));
    for (const char* name : {"a.exr", "a.png"}) put(directory.path / name, "old");
    outcome = run({"render", "bright.json", "-o", "a", "--strict"}, there);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "NaN became 0 (a warning, but --strict was given)\n"));
    for (const char* name : {"a.exr", "a.png"}) CHECK(content_of(directory.path / name) == "old");
    CHECK(run({"render", "bright.json", "-o", "a", "--strict", "--float", "--no-ambient"}, there).code == 0);
}

TEST_CASE("130 and 143: an interrupted frame leaves the old files and nothing else") {
    const TemporaryDirectory directory;
    put(directory.path / "a.png", "old png");
    std::vector<std::string> hours{"render", small, "-o", "a", "--size", "8192x8192", "--aa", "grid", "--aa-samples", "16"};
    const bool terminal = have_terminals();
    for (const int signal : {SIGINT, SIGTERM}) {
        if (signal == SIGTERM) // and where one tile takes hours
            hours.insert(hours.end(), {"--tile", "64", "--soft-shadows", "1024", "--depth", "64", "--precision", "reference"});
        const Outcome outcome = run(hours, {.directory = directory.path,
                                            .environment = {"TERM=xterm"},
                                            .terminal = terminal,
                                            .signal_at = terminal ? " % [" : "rendering",
                                            .signal = signal});
        CHECK(outcome.code == 128 + signal);
        CHECK(contains(outcome.err, "lanecast: interrupted"));
        CHECK(content_of(directory.path / "a.png") == "old png");
        CHECK(names_in(directory.path).size() == 1);
    }
}
