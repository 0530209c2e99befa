#pragma once
// Records of bodies, for tests of what meets them.

#include "scene/scene_view.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::test {

inline float stretch_of(const AffineRecord& record) {
    const auto row = [&](int i) {
        return std::abs(record.object_from_world[i]) + std::abs(record.object_from_world[i + 1]) +
               std::abs(record.object_from_world[i + 2]);
    };
    return std::max({row(0), row(3), row(6)});
}
/// A body in its own space.
inline AffineRecord own_space(float taper = 0) {
    return {.translation = {0, 0, 0}, .object_from_world = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .taper = taper, .stretch = 1, .radius = 3.6f, .padding = 0};
}

} // namespace lanecast::test
