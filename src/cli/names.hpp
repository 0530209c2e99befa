#pragma once
// Words for what a scene holds.

#include "scene/description.hpp"

#include <string>

namespace lanecast {

/// "sphere", "cylinder", "plane", "mesh".
[[nodiscard]] inline const char* type_name(const Shape& shape) {
    static constexpr const char* names[] = {"sphere", "cylinder", "plane", "mesh"};
    return names[shape.index()];
}

/// "ambient", "directional", "point", "spot".
[[nodiscard]] inline const char* type_name(const Light& light) {
    static constexpr const char* names[] = {"ambient", "directional", "point", "spot"};
    return names[light.index()];
}

} // namespace lanecast
