#pragma once
// How good a tree is, from its nodes alone.

#include "scene/scene_view.hpp"

#include <cstdint>

namespace lanecast {

/// What `info` reports of the tree.
struct BvhQuality {
    std::uint32_t nodes = 0;
    std::uint32_t leaves = 0;
    int depth = 0;       ///< levels of nodes; 0 without a tree
    double sah_cost = 0; ///< expected node visits + primitive tests of a random ray that enters the root
    std::uint32_t leaf_sizes[max_leaf_size + 1] = {}; ///< leaves by number of primitives
    double overlapping_share = 0; ///< of nodes in which two children share more than half of the smaller one's box
};

/// Of the tree with its root at arena + 0; null: there is none. Asked for where it is shown: done with every build it took 3 % of
/// the time.
[[nodiscard]] BvhQuality measure_quality(const unsigned char* arena);

/// Whether two of the node's children share more than half of the smaller one's box. Along an axis on which a box is flat,
/// it counts as wholly shared where the other contains it.
[[nodiscard]] bool children_overlap(const BvhNode& node);

} // namespace lanecast
