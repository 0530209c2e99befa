#pragma once
// Meshes from files: OBJ with its MTL, PLY. Counts and indices are checked against the file before anything is allocated.

#include "scene/description.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

/// More vertices or triangles than this in one scene are refused: 2^27 of each are 5 GB.
inline constexpr std::size_t max_mesh_elements = std::size_t{1} << 27;

struct MeshWarnings {
    bool strict = false;                    ///< the first one is an error
    std::vector<std::string> messages = {}; ///< complete; the first ten
    std::size_t dropped = 0;                ///< how many came after those
};

enum class MeshFormat { unknown, obj, ply };
[[nodiscard]] MeshFormat mesh_format(const std::filesystem::path& file); ///< by its extension, upper or lower case

/// `name` is the file's in messages. Throws Error(asset): `name:line:column: error: ...` for texts, `name: error: at byte ...`
/// for binary.
[[nodiscard]] Mesh read_ply(std::string_view bytes, const std::string& name);
/// The same; material libraries are looked for in `directory`. `base` supplies what the materials of an MTL leave out, and is the
/// material of faces that name none.
[[nodiscard]] Mesh read_obj(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                            const Material& base, MeshWarnings& warnings);

} // namespace lanecast
