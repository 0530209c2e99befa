// tests/errors/expected.txt has a line `file <tab> exit code <tab> first line of the message` for each bad scene beside it.

#include "scene/error.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene_message.hpp"
#include "scene/text_tools.hpp"

#include <fstream>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

struct Expected {
    int code;
    std::string first_line;
};

const std::filesystem::path directory = std::filesystem::path(LANECAST_SOURCE_DIR) / "tests/errors";

std::map<std::string, Expected> read_expected() {
    std::map<std::string, Expected> out;
    std::ifstream file(directory / "expected.txt");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find('\t');
        const std::size_t second = line.find('\t', first + 1);
        out[line.substr(0, first)] = {std::stoi(line.substr(first + 1)), line.substr(second + 1)};
    }
    return out;
}

/// As the commands do it: faults that only the arrays show get their place in the file afterwards.
void load_and_flatten(const std::filesystem::path& file) {
    const LoadedScene scene = load_scene(file);
    try {
        (void)flatten(scene.description, scene.description.render, 1);
    } catch (const Error& error) {
        throw Error(error.code(), message_in_scene(file, "error", error.what()));
    }
}

std::string without_directory(std::string text) {
    const std::string prefix = directory.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) out.push_back(line);
    return out;
}

/// The lines after the first: the source line, and a caret below the column the first line names, with the line's tabs before it.
void check_caret(const std::vector<std::string>& message) {
    REQUIRE(message.size() >= 3);
    const std::string& source = message[1];
    if (source.starts_with("...")) return;
    std::size_t place = message[0].find(':');
    place = message[0].find(':', place + 1) + 1; // after file and line
    std::string caret;
    std::size_t left = std::stoul(message[0].substr(place)) - 1;
    for (std::size_t i = 0; i < source.size() && left > 0; ++i) {
        if ((source[i] & 0xc0) == 0x80) continue; // inside a character
        caret += source[i] == '\t' ? '\t' : ' ';
        --left;
    }
    CHECK(left == 0);
    CHECK(message[2] == caret + "^");
}

} // namespace

TEST_CASE("every bad scene gives the expected line and exit code") {
    std::map<std::string, Expected> expected = read_expected();
    CHECK(expected.size() >= 200);
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() != ".json") continue;
        CAPTURE(name);
        REQUIRE_MESSAGE(expected.contains(name), "expected.txt lacks this file");
        const Expected wanted = expected[name];
        expected.erase(name);
        try {
            load_and_flatten(entry.path());
            FAIL_CHECK("no error");
        } catch (const Error& error) {
            const std::vector<std::string> message = lines_of(without_directory(error.what()));
            CHECK(message.front() == wanted.first_line);
            CHECK(static_cast<int>(error.code()) == wanted.code);
            if (wanted.first_line.find(": error: at byte") == std::string::npos) check_caret(message);
            // A fault in a mesh also says who asked for it.
            const bool in_mesh = !wanted.first_line.starts_with(name);
            const bool has_note = message.size() > 3 && message[message.size() - 3].starts_with(
                                                            name + ":6:15: note: /objects/0/file: asks for this file");
            CHECK(in_mesh == has_note);
        }
    }
    for (const auto& [name, wanted] : expected) FAIL_CHECK("no such file: " << name);
}

TEST_CASE("files that cannot be read") {
    const auto message_of = [](const std::filesystem::path& file) {
        try {
            (void)load_scene(file);
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::scene);
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message_of("no/such/scene.json") == "no/such/scene.json: error: cannot read the scene: No such file or directory");
    CHECK(message_of("/") == "/: error: cannot read the scene: Is a directory");
    CHECK(message_of("/dev/zero") == "/dev/zero: error: cannot read the scene: Not a regular file");
}

TEST_CASE("a long source line is cut around the place") {
    const std::string filler(500, '1');
    const std::string text = R"({"camera": {}, "_a": ")" + filler + R"(", "objects": 5, "_b": ")" + filler + R"("})";
    try {
        (void)parse_scene(text, "long.json", {});
        FAIL("loaded");
    } catch (const Error& error) {
        const std::vector<std::string> lines = lines_of(error.what());
        REQUIRE(lines.size() == 3);
        CHECK(lines[0] == "long.json:1:537: error: /objects: must be a list [ ... ], got 5");
        CHECK(lines[1].size() < 140);
        CHECK(lines[1].starts_with("..."));
        CHECK(lines[1].ends_with("..."));
        CHECK(lines[1][lines[2].size() - 1] == '5');
    }
}

TEST_CASE("nothing from a file reaches the terminal raw") {
    try {
        (void)parse_scene("{\"camera\": {}, \"_\": \"\x7f\xc2\x9b\", \"objects\": \"\\u001b[31m\", \"lights\": []}", "esc.json",
                          {});
        FAIL("loaded");
    } catch (const Error& error) {
        for (const char c : std::string(error.what())) CHECK((c == '\n' || (c >= 0x20 && c < 0x7f)));
    }
}
