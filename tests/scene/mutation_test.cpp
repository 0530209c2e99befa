// Damaged scenes and meshes: always a scene or an Error with a well-formed message, never anything else.

#include "scene/error.hpp"
#include "scene/load_scene.hpp"
#include "scene/mesh_file.hpp"
#include "scene/read_file.hpp"

#include "scene/random_scene.hpp"
#include "scene/write_scene.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

const std::filesystem::path corpus = std::filesystem::path(LANECAST_SOURCE_DIR) / "tests/errors";

std::mt19937_64 generator(7);
std::size_t below(std::size_t bound) { return std::uniform_int_distribution<std::size_t>(0, bound - 1)(generator); }

std::string damaged(std::string text) {
    static const std::string pieces[] = {
        "1e999", "-1",   "0", "1e308", "null", "[",   "]", "{", "}",  "\"", ",",  "99999999999", "nan",  "-inf",
        "\n",    "type", "/", "\\",    "\xff", "3.5", " ", ":", "f ", "v ", "\t", "e",           "true", "4294967295"};
    for (std::size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
        const std::size_t at = below(text.size());
        switch (below(6)) {
        case 0:
            text[at] = static_cast<char>(below(256));
            break;
        case 1:
            text.resize(at);
            break;
        case 2:
            text.erase(at, 1 + below(12));
            break;
        case 3:
            text.insert(at, text.substr(below(text.size()), 1 + below(40)));
            break;
        case 4:
            text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            break;
        default:
            text.insert(at, pieces[below(std::size(pieces))]);
        }
    }
    return text;
}

/// Drops `piece` from the front of `text` and tells whether it was there; a '#' in `piece` stands for digits.
bool take(std::string_view& text, std::string_view piece) {
    std::string_view rest = text;
    for (const char c : piece) {
        if (c == '#') {
            const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
            if (digits == 0) return false;
            rest.remove_prefix(digits);
        } else {
            if (rest.empty() || rest.front() != c) return false;
            rest.remove_prefix(1);
        }
    }
    text = rest;
    return true;
}

/// file:line:column: severity: or, for binary meshes, file: error: at byte n:
void check_message(const std::string& message) {
    CAPTURE(message);
    std::string_view rest = message;
    rest.remove_prefix(std::min(rest.find(':'), rest.size()));
    REQUIRE(rest.size() < message.size());
    REQUIRE((take(rest, ":#:#: error: ") || take(rest, ":#:#: warning: ") || take(rest, ": error: at byte #: ") ||
             take(rest, ": error: more than ") || take(rest, ": warning: # more")));
    REQUIRE(!rest.empty());
    REQUIRE(message.find("malformed JSON") == std::string::npos);
    for (const char c : message) REQUIRE((c == '\n' || c == '\t' || static_cast<unsigned char>(c) >= 0x20));
}

bool finite(const Json& json) {
    if (json.is_number()) return std::isfinite(json.get<double>());
    for (const Json& item : json)
        if (item.is_structured() || item.is_number())
            if (!finite(item)) return false;
    return true;
}

bool survives(const std::string& text) {
    try {
        const LoadedScene loaded = parse_scene(text, "damaged.json", corpus);
        for (const std::string& warning : loaded.warnings) check_message(warning);
        REQUIRE(finite(to_json(loaded.description)));
        return true;
    } catch (const Error& error) {
        check_message(error.what());
        REQUIRE((error.code() == ExitCode::scene || error.code() == ExitCode::asset));
        return false;
    }
}

bool mesh_survives(const std::string& bytes, bool obj) {
    try {
        MeshWarnings warnings;
        const Mesh mesh = obj ? read_obj(bytes, "damaged.obj", corpus, {}, warnings) : read_ply(bytes, "damaged.ply");
        for (const std::string& warning : warnings.messages) check_message(warning);
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t index : triangle) REQUIRE(index < mesh.positions.size());
        for (const glm::dvec3& p : mesh.positions) REQUIRE((std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)));
        REQUIRE((mesh.triangle_material.empty() || mesh.triangle_material.size() == mesh.triangles.size()));
        for (const std::uint32_t material : mesh.triangle_material) REQUIRE(material < mesh.materials.size());
        return true;
    } catch (const Error& error) {
        check_message(error.what());
        REQUIRE((error.code() == ExitCode::asset || error.code() == ExitCode::memory));
        return false;
    }
}

} // namespace

TEST_CASE("damaged scenes") {
    int loaded = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const std::string text = to_json(RandomScene(seed).scene()).dump(seed % 2 == 0 ? 1 : -1);
        REQUIRE(survives(text));
        for (int i = 0; i < 20; ++i) loaded += survives(damaged(text)) ? 1 : 0;
    }
    CHECK(loaded > 100); // or the damage is so coarse that only the tokenizer is tested
}

TEST_CASE("scenes cut anywhere") {
    const std::string text = to_json(RandomScene(3).scene()).dump(1);
    for (std::size_t length = 0; length < text.size(); ++length) REQUIRE(!survives(text.substr(0, length)));
}

TEST_CASE("damaged bad scenes and meshes") {
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        const std::string extension = entry.path().extension().string();
        const FileBytes file = read_file(entry.path());
        REQUIRE(file.fault.empty());
        if (file.size > 10000) continue;
        const std::string bytes(file.view());
        for (int i = 0; i < 40; ++i) {
            if (extension == ".json") survives(damaged(bytes));
            if (extension == ".obj" || extension == ".ply") mesh_survives(damaged(bytes), extension == ".obj");
        }
    }
}

TEST_CASE("damaged good meshes") {
    const std::string obj =
        "mtllib bad.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nusemtl red\nf 1/1 2/2 3/3 4/4\nf -1//-1 -2 \\\n -3\n";
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float "
                               "y\nproperty double z\nelement face 2\n"
                               "property uchar c\nproperty list uchar int vertex_indices\nend_header\n";
    std::string ply = header + std::string(64, '\0') + '\0' + '\3' + std::string(12, '\0') + '\0' + '\4' + std::string(16, '\0');
    const std::string plain = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float "
                              "y\nproperty float z\nelement face 2\n"
                              "property list uchar int vertex_indices\nend_header\n" +
                              std::string(24, '\0') + '\3' + std::string(12, '\0') + '\3' + std::string(12, '\0');
    const std::string ascii =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto good = [](const std::string& bytes) { return mesh_survives(bytes, false); };
    REQUIRE(good(ply));
    REQUIRE(good(plain));
    REQUIRE(good(ascii));
    REQUIRE(mesh_survives(obj.substr(obj.find('\n') + 1), true));
    for (int i = 0; i < 5000; ++i) {
        mesh_survives(damaged(obj), true);
        for (const std::string* bytes : {&std::as_const(ply), &plain, &ascii}) mesh_survives(damaged(*bytes), false);
    }
}
