#pragma once
// A plot as a list of shapes, as SVG or as pixels.

#include "render/png_io.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace lanecast::bench {

enum class Anchor { start, middle, end };

struct Box {
    double x, y, width, height;
    std::string colour; ///< "#rrggbb"
};
struct Label {
    double x, y; ///< of the base line
    std::string text;
    Anchor anchor = Anchor::middle;
    int size = 12;
};

/// Lengths in pixels of the SVG, y down. Boxes in their order, then the labels.
struct Drawing {
    double width = 0, height = 0;
    std::vector<Box> boxes; ///< lines are thin ones
    std::vector<Label> labels;
};

[[nodiscard]] std::string svg_of(const Drawing& drawing);
/// Twice as wide and high. Letters are capitals.
[[nodiscard]] Picture8 picture_of(const Drawing& drawing);

/// As a PNG where `file` ends so, else as an SVG.
void write_drawing(const std::filesystem::path& file, const Drawing& drawing);
[[nodiscard]] bool is_png(const std::filesystem::path& file);

} // namespace lanecast::bench
