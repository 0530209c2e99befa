#pragma once
// The files of a frame: both appear or none.

#include "render/exr_io.hpp"
#include "render/film.hpp"
#include "render/tonemap.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace lanecast {

/// Empty: not asked for.
struct PictureNames {
    std::filesystem::path exr, png;
};

/// `output`: a name that gets .exr and .png; or one that ends in one of them, upper or lower case, and then only that file; or
/// empty or a directory with a slash at its end: the scene's stem there. Throws Error: usage for the ending of another picture
/// format, output for a directory without its slash.
[[nodiscard]] PictureNames picture_names(const std::string& output, const std::filesystem::path& scene);

/// Throws Error (output) where a file could not be put there. Leaves nothing behind.
void probe_outputs(const PictureNames& names);

struct PictureOptions {
    ExrOptions exr; ///< its threads are set by write_pictures
    View view = default_view;
    double exposure = 0;
    int threads = 1;
};

/// `before_commit` may throw: then nothing was written. Throws Error (output).
void write_pictures(const PictureNames& names, const Film& film, const PictureOptions& options,
                    const std::function<void()>& before_commit);

} // namespace lanecast
