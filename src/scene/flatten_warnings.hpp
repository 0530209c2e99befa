#pragma once
// What a scene loses when it is flattened, told at most once each. The texts start with the JSON pointer of an object.

#include "scene/bounds.hpp"
#include "scene/bvh_refs.hpp"
#include "scene/flatten_objects.hpp"
#include "scene/scene_arrays.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lanecast {

/// An object of fewer steps of the float grid than this, in its longest direction, loses detail that shows. docs/numerics.md has
/// the measurement.
inline constexpr double fewest_steps = 256;

/// Of the smallest object below fewest_steps, and of the one that reaches farthest from it, which is why the grid is so coarse.
/// `boxes`: of each object of the file, in world units, empty for planes.
[[nodiscard]] std::optional<std::string> fine_object_warning(const FlatObjects& objects, const std::vector<DoubleBox>& boxes,
                                                             const Normalisation& normalisation);

/// Names the first mesh. `dropped`: some places, in order, counted over the bounded primitives in file order.
[[nodiscard]] std::string dropped_triangles_warning(const FlatObjects& objects, const std::vector<std::uint32_t>& dropped);

} // namespace lanecast
