#pragma once
// 8-bit RGB PNG out, any PNG in.

#include "render/film.hpp"
#include "render/output_file.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lanecast {

/// A tEXt chunk: a key of 1 to 79 bytes of Latin-1, and its text.
struct PngText {
    std::string key, text;
};

/// Interleaved 8-bit RGB, row by row from the top.
struct Picture8 {
    int width = 0, height = 0;
    ZeroVector<std::uint8_t> rgb; ///< 3 * width * height
    std::vector<PngText> texts{};
};

/// With sRGB, gAMA and cHRM chunks. Equal pictures give equal bytes. Throws Error (output); see OutputFile.
void write_png(const std::filesystem::path& path, const Picture8& picture);
/// The same without the commit.
void write_png(OutputFile& file, const Picture8& picture);

/// The code values divided by 255 (65535 for 16 bit): no curve is undone. Palettes and greys become RGB, alpha is ignored.
/// Throws Error (asset).
[[nodiscard]] Film read_png(const std::filesystem::path& path);

} // namespace lanecast
