#pragma once
// The same scene over a tree whose leaves have a given size, which the usual builder chooses by cost.

#include "scene/scene_arrays.hpp"

namespace lanecast::selftest {

/// Leaves of `leaf_size` primitives, but for the last of each kind. `arrays` has no leaves of shared triangles. Slots are
/// numbered anew.
[[nodiscard]] SceneArrays with_leaves_of(const SceneArrays& arrays, int leaf_size);

} // namespace lanecast::selftest
