#pragma once
// Where a measurement was made, for its record.

#include <string>

namespace lanecast {

[[nodiscard]] std::string cpu_name();
[[nodiscard]] const char* compiler_name();

} // namespace lanecast
