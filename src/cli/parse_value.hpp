#pragma once
// Values of options. Faults are CLI::ValidationError, which names the option, what it expects and what it got.

#include "render/kernel_table.hpp"
#include "scene/scene_format.hpp"

#include <array>
#include <string>

namespace lanecast {

/// By the rules of the scene format: `key` has kind and range. A whole value for whole numbers.
[[nodiscard]] double parse_number(const std::string& option, const std::string& text, const KeySpec& key);

/// "640x480", checked against the limits of the scene format.
[[nodiscard]] std::array<int, 2> parse_size(const std::string& option, const std::string& text);

/// "x0,y0,x1,y1", x1 and y1 exclusive; not empty, not negative.
[[nodiscard]] Tile parse_crop(const std::string& option, const std::string& text);

} // namespace lanecast
