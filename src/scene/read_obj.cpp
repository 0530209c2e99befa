// Wavefront OBJ: vertices, faces and materials. Texture coordinates, normals, groups, lines and curves are skipped.

#include "scene/mesh_file.hpp"
#include "scene/read_file.hpp"
#include "scene/read_mtl.hpp"
#include "scene/text_cursor.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_set>

namespace lanecast {
namespace {

constexpr std::size_t max_mesh_warnings = 10;

/// Statements that are no fault but mean nothing to this program.
constexpr std::string_view skipped[] = {
    "vt",       "vn",       "vp",    "g",      "o",      "s",          "l",         "p",     "mg",    "deg",  "bmat", "step",
    "cstype",   "curv",     "curv2", "surf",   "parm",   "trim",       "hole",      "scrv",  "sp",    "end",  "con",  "bevel",
    "c_interp", "d_interp", "lod",   "maplib", "usemap", "shadow_obj", "trace_obj", "ctech", "stech", "call", "csh"};

struct ObjReader {
    TextCursor cursor;
    std::filesystem::path directory;
    MeshWarnings& warnings;
    Mesh mesh = {};
    MaterialLibrary library = {};
    std::uint32_t material = 0; ///< current, index into library.materials
    std::unordered_set<std::string> libraries_read = {};
    bool library_missing = false;
    std::uint32_t largest_forward = 0; ///< largest index that named a vertex not yet read; 1-based
    const char* forward_place = nullptr;
    std::vector<std::uint32_t> corners = {}; ///< of the face being read

    void warn(const char* place, const std::string& what) {
        if (warnings.strict) cursor.fail(place, what + std::string(strict_suffix));
        if (warnings.messages.size() < max_mesh_warnings)
            warnings.messages.push_back(cursor.message(place, "warning", what));
        else
            ++warnings.dropped;
    }

    void read_vertex() {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) position[axis] = cursor.number("a coordinate");
        if (mesh.positions.size() == max_mesh_elements)
            throw Error(ExitCode::memory, cursor.name + ": error: more than " + std::to_string(max_mesh_elements) + " vertices");
        mesh.positions.push_back(position);
    }

    /// `3`, `3/1`, `3//2` or `3/1/2`; negative counts from the last vertex. Only the first number matters.
    std::uint32_t read_corner() {
        const char* const start = cursor.at;
        long long index = 0;
        const auto read_index = [&](long long& value) {
            const std::from_chars_result parsed = std::from_chars(cursor.at, cursor.end, value);
            if (parsed.ec != std::errc()) cursor.fail_word(start, "a vertex `v`, `v/vt`, `v//vn` or `v/vt/vn`");
            cursor.at = parsed.ptr;
        };
        read_index(index);
        for (int slashes = 0; slashes < 2 && cursor.at != cursor.end && *cursor.at == '/'; ++slashes) {
            ++cursor.at;
            long long unused = 0;
            if (cursor.at != cursor.end && *cursor.at != '/' && !TextCursor::is_space(*cursor.at)) read_index(unused);
        }
        if (cursor.at != cursor.end && !TextCursor::is_space(*cursor.at))
            cursor.fail_word(start, "a vertex `v`, `v/vt`, `v//vn` or `v/vt/vn`");
        const auto count = static_cast<long long>(mesh.positions.size());
        if (index == 0) cursor.fail(start, "vertex 0 does not exist, the first is 1");
        if (index < -count)
            cursor.fail(start, "vertex " + std::to_string(index) + " does not exist, " + std::to_string(count) +
                                   " come before this line");
        if (index < 0) return static_cast<std::uint32_t>(count + index);
        if (index > static_cast<long long>(max_mesh_elements))
            cursor.fail(start, "vertex " + std::to_string(index) + " does not exist");
        if (index > count && index > largest_forward) { // may still come
            largest_forward = static_cast<std::uint32_t>(index);
            forward_place = start;
        }
        return static_cast<std::uint32_t>(index - 1);
    }

    void read_face(const char* start) {
        corners.clear();
        while (!cursor.at_statement_end()) corners.push_back(read_corner());
        if (corners.size() < 3) cursor.fail(start, "a face needs at least three vertices, got " + std::to_string(corners.size()));
        for (std::size_t i = 2; i < corners.size(); ++i) {
            mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
            if (library.materials.size() > 1) mesh.triangle_material.push_back(material);
        }
        if (mesh.triangles.size() > max_mesh_elements)
            throw Error(ExitCode::memory, cursor.name + ": error: more than " + std::to_string(max_mesh_elements) + " triangles");
    }

    void read_library(const char* place, std::string_view file_name) {
        if (!libraries_read.insert(std::string(file_name)).second) return; // some exporters name it before every object
        const std::filesystem::path file = directory / file_name;
        FileBytes bytes;
        if (file_name.find('\0') == std::string_view::npos)
            bytes = read_file(file);
        else
            bytes.fault = "Invalid name";
        if (!bytes.fault.empty()) {
            library_missing = true;
            warn(place, "cannot read the materials `" + printable(file_name) + "`: " + bytes.fault);
            return;
        }
        read_mtl(bytes.view(), printable_path(file), library);
        mesh.triangle_material.resize(mesh.triangles.size());
    }

    /// `mtllib a.mtl b.mtl`, or one name with blanks in it.
    void read_libraries() {
        std::string_view names = cursor.rest_of_line();
        std::error_code ignored;
        const bool one_file =
            names.find_first_of(" \t") == std::string_view::npos || std::filesystem::is_regular_file(directory / names, ignored);
        if (one_file) return read_library(names.data(), names);
        while (!names.empty()) {
            const std::size_t length = std::min(names.find_first_of(" \t"), names.size());
            read_library(names.data(), names.substr(0, length));
            names.remove_prefix(std::min(names.find_first_not_of(" \t", length), names.size()));
        }
    }

    void use_material() {
        const std::string_view wanted = cursor.rest_of_line();
        const auto found = library.index.find(std::string(wanted));
        material = found == library.index.end() ? 0 : found->second;
        if (found == library.index.end() && !library_missing)
            warn(wanted.data(), "the material `" + printable(wanted) + "` is not defined; the object's own is used");
    }

    void read_statement() {
        if (cursor.at_statement_end()) return;
        const char* const start = cursor.at;
        const std::string_view keyword = cursor.word();
        if (keyword == "v") return read_vertex();
        if (keyword == "f" || keyword == "fo") return read_face(start);
        if (keyword == "usemtl") return use_material();
        if (keyword == "mtllib") return read_libraries();
        if (std::ranges::find(skipped, keyword) == std::end(skipped))
            warn(start, "unknown statement `" + printable(keyword) + "`");
    }
};

} // namespace

Mesh read_obj(std::string_view text, const std::string& name, const std::filesystem::path& directory, const Material& base,
              MeshWarnings& warnings) {
    ObjReader reader{.cursor = {.text = text, .name = name}, .directory = directory, .warnings = warnings};
    reader.library.materials.push_back(base);
    for (; reader.cursor.at != reader.cursor.end; reader.cursor.skip_statement()) reader.read_statement();
    if (reader.largest_forward > reader.mesh.positions.size())
        reader.cursor.fail(reader.forward_place, "vertex " + std::to_string(reader.largest_forward) +
                                                     " does not exist, the file has " +
                                                     std::to_string(reader.mesh.positions.size()));
    if (std::ranges::any_of(reader.mesh.triangle_material, [](std::uint32_t m) { return m != 0; }))
        reader.mesh.materials = std::move(reader.library.materials);
    else
        reader.mesh.triangle_material.clear();
    return std::move(reader.mesh);
}

} // namespace lanecast
