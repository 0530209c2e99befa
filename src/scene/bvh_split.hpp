#pragma once
// One step of the build: a range of primitives into two.

#include "scene/bvh_spatial.hpp"

namespace lanecast {

/// Box, centres and kinds of range.first .. + count.
void measure(const BuildRef* refs, BuildRange& range);

/// Splits `range` (count >= 2) in place into two that are not empty, by the surface area heuristic: exactly up to 16 primitives,
/// else with up to 32 bins on each axis. Where centres coincide it splits mixed kinds by kind, and one kind by count. With more
/// than one thread the binning of large ranges is shared; the result is the same. With `spatial`, which may be null, planes
/// through triangles compete in ranges of more than 16.
void split_by_area(BuildRef* refs, const BuildRange& range, const SpatialSplits* spatial, int threads, BuildRange halves[2]);

/// The same by count alone, along the widest axis of the centres: halves the depth that is still to come.
void split_by_count(BuildRef* refs, const BuildRange& range, BuildRange halves[2]);

} // namespace lanecast
