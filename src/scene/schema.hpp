#pragma once
// scenes/scene.schema.json, built into the program for `lanecast schema`.

#include <string_view>

namespace lanecast {

[[nodiscard]] std::string_view scene_schema() noexcept;

} // namespace lanecast
