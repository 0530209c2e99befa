#pragma once
// The binary tree from which the eight-wide one is collapsed.

#include "scene/bvh_spatial.hpp"
#include "scene/scratch.hpp"

#include <cstddef>
#include <cstdint>

namespace lanecast {

struct BinaryNode {
    float lo[3];
    std::uint32_t children; ///< index of the left one, the right one follows; 0: a leaf
    float hi[3];
    float area;                 ///< half the surface
    std::uint32_t first, count; ///< primitives of the leaf, or of the subtree
};

[[nodiscard]] inline bool is_leaf(const BinaryNode& node) noexcept { return node.children == 0; }

struct BinaryTree {
    Scratch<BinaryNode> nodes;  ///< root at 0; the order of the others depends on the threads, the tree does not
    std::size_t node_count = 0; ///< with those between that are not used
};

/// What spatial splits need: `refs` has room for `capacity` references.
struct SpatialRoom {
    CornersOf corners_of;
    std::function<std::size_t(const BuildRef&)> index_of; ///< of the primitive among `primitives`
    std::size_t primitives = 0, capacity = 0;
};

/// Reorders `refs` (1 <= count < 2^31) so that every node has a contiguous range. Leaves hold one kind and at most max_leaf_size
/// primitives; a range becomes one where area (0.75 + 0.25 count) is no more than the cost of its subtree, whose inner nodes cost
/// their area. At most max_bvh_depth levels of inner nodes.
[[nodiscard]] BinaryTree build_binary(BuildRef* refs, std::size_t count, const SpatialRoom* spatial, int threads);

} // namespace lanecast
