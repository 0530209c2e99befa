#pragma once
// Meshes from files: OBJ with its MTL, PLY. Counts and indices are checked against the file before anything is allocated.

#include "scene/description.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

/// More vertices or triangles than this in one scene are refused: 2^27 of each are 5 GB.
inline constexpr std::size_t max_mesh_elements = std::size_t{1} << 27;

/// Reads a mesh by its extension. Throws Error(asset) with `file:line:column: error: ...`. `base` supplies what the materials
/// of an MTL leave out. `warnings` gains complete messages.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const Material& base, std::vector<std::string>& warnings);

/// The readers themselves, for a text in memory.
[[nodiscard]] Mesh read_ply(std::string_view bytes, const std::string& name);
[[nodiscard]] Mesh read_obj(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                            const Material& base, std::vector<std::string>& warnings);

} // namespace lanecast
