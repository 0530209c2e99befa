#pragma once
// Spatial splits (Stich, Friedrich and Dietrich 2009): a plane through triangles, each of which then stands in both halves, with
// the box of its part on that side.

#include "scene/bvh_bins.hpp"
#include "scene/bvh_refs.hpp"

#include <array>
#include <functional>

namespace lanecast {

/// Corners of a triangle.
using CornersOf = std::function<std::array<const float*, 3>(const BuildRef&)>;

struct SpatialSplits {
    CornersOf corners_of;
    float least_overlap = 0; ///< half area shared by the halves of a cut below which a spatial split is not tried
};

/// Splits `range` by a plane where that is cheaper than `cut`, within range.capacity; else changes nothing and returns false.
/// Both halves have fewer references than the range. What is not a triangle goes to one side whole.
[[nodiscard]] bool split_by_plane(BuildRef* refs, const BuildRange& range, const BinCut& cut, const SpatialSplits& splits,
                                  BuildRange halves[2]);

/// The triangle's parts below and above x on an axis, within the reference's box: bit 0, bit 1 where that part is not empty.
/// A corner is four readable floats. Boxes are 2^-14 of the triangle's extent larger: t of a ray nearly in its plane may be that
/// far off (docs/numerics.md).
[[nodiscard]] unsigned chop(const BuildRef& ref, const std::array<const float*, 3>& corners, int axis, float x,
                            BuildRef parts[2]);

} // namespace lanecast
