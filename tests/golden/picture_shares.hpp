#pragma once
// 8-bit pictures against each other: the largest difference of a pixel's channels, in codes, and shares of pixels.

#include "render/png_io.hpp"
#include "render/tonemap.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace lanecast::test {

/// Linear, clamped, rounded: how the reference pictures were written.
[[nodiscard]] inline Picture8 plain(const Film& film) { return tonemap(film, View::plain); }

/// Per pixel.
[[nodiscard]] inline std::vector<int> differences(const Picture8& a, const Picture8& b) {
    std::vector<int> largest(a.rgb.size() / 3);
    for (std::size_t i = 0; i < a.rgb.size(); ++i) largest[i / 3] = std::max(largest[i / 3], std::abs(a.rgb[i] - b.rgb[i]));
    return largest;
}

/// 1 for the pixels that differ by more than `codes`.
[[nodiscard]] inline std::vector<std::uint8_t> beyond(const std::vector<int>& differences, int codes) {
    std::vector<std::uint8_t> pixels(differences.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = differences[i] > codes ? 1 : 0;
    return pixels;
}

[[nodiscard]] inline double share(const std::vector<std::uint8_t>& pixels) {
    return static_cast<double>(std::count(pixels.begin(), pixels.end(), std::uint8_t{1})) / static_cast<double>(pixels.size());
}

[[nodiscard]] inline double share_beyond(const Picture8& a, const Picture8& b, int codes) {
    return share(beyond(differences(a, b), codes));
}

} // namespace lanecast::test
