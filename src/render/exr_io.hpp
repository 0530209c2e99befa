#pragma once
// Films as OpenEXR files: scanlines, ZIPS, linear Rec.709; docs/output.md has channels and attributes.

#include "render/film.hpp"
#include "render/output_file.hpp"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace lanecast {

struct ExrAttribute {
    std::string name; ///< "lanecast:..." by convention
    std::variant<std::string, int, float, double> value;
};

struct ExrOptions {
    bool float_pixels = false;     ///< 32 bit per channel instead of half
    float screen_window_width = 1; ///< width of the whole image at distance 1 from the eye
    int threads = 1;               ///< that compress; the file's bytes do not depend on it
    std::vector<ExrAttribute> attributes;
};

/// Display window: the whole image; data window: the film. Equal films and options (but for threads) give equal bytes. Half
/// pixels are rounded to nearest even and clamped to +-65504; NaN is written as 0, an infinity as the largest value of its sign:
/// see scrub.hpp to count them. Throws Error (output); see OutputFile for what happens to the file then.
void write_exr(const std::filesystem::path& path, const Film& film, const ExrOptions& options = {});
/// The same without the commit.
void write_exr(OutputFile& file, const Film& film, const ExrOptions& options);

/// The first part's R, G and B, or its Y three times; any windows, half or float. The film's pixel (0, 0) is the display window's
/// corner. Throws Error (asset).
[[nodiscard]] Film read_exr(const std::filesystem::path& path);

} // namespace lanecast
