#pragma once
// How good a tree is, from its nodes alone.

#include "scene/scene_arrays.hpp"

namespace lanecast {

/// Of the tree with its root at arena + 0; `node_offsets` in units of 64 bytes, `depth` as built. Sums are made in the order of
/// the nodes.
[[nodiscard]] BvhQuality measure_quality(const unsigned char* arena, const std::vector<std::uint32_t>& node_offsets, int depth,
                                         int threads);

/// Whether two of the node's children share more than half of the smaller one's box. Along an axis on which a box is flat,
/// it counts as wholly shared where the other contains it.
[[nodiscard]] bool children_overlap(const BvhNode& node);

} // namespace lanecast
