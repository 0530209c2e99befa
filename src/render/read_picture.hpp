#pragma once
// A picture from a file of either kind.

#include "render/film.hpp"

#include <filesystem>

namespace lanecast {

enum class PictureKind { exr, png };

/// By the first bytes, whatever the name. Throws Error (asset) for a missing file and for any other kind.
[[nodiscard]] PictureKind picture_kind(const std::filesystem::path& path);

/// See read_exr and read_png.
[[nodiscard]] Film read_picture(const std::filesystem::path& path);

} // namespace lanecast
