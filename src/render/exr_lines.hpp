#pragma once
// The scanlines of an OpenEXR file with ZIPS compression, as they lie in the file (OpenEXR File Layout, "Scan Line Blocks").

#include "render/film.hpp"

#include <cstdint>
#include <vector>

namespace lanecast {

/// Consecutive lines: each its y and its size, 4 bytes each, and its pixels.
struct ExrLines {
    std::vector<unsigned char> bytes;
    std::vector<std::uint32_t> sizes; ///< by line, of all three
};

/// The film from top to bottom, some lines in each: halves, or floats. See exr_io.hpp for what becomes of values that are not to
/// be had. The lines do not depend on `threads`. Throws std::bad_alloc.
[[nodiscard]] std::vector<ExrLines> compress_lines(const Film& film, bool float_pixels, int threads);

} // namespace lanecast
