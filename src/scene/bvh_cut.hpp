#pragma once
// Which nodes of the binary tree become children of eight-wide ones: the cheapest choice, by dynamic programming (Wald, Benthin
// and Boulos 2008; Ylitie, Karras and Laine 2017).

#include "scene/bvh_binary.hpp"
#include "scene/scratch.hpp"

#include <cstdint>

namespace lanecast {

/// Per binary node, a nibble for each number of places that its subtree may take in a wide node, from bit 4 (places - 1) on: how
/// many of them the left half gets; 0: the subtree is one child. Of the eight places: of the wide node that it becomes. Of one
/// place: 1 where that one child is a leaf.
using Cuts = Scratch<std::uint32_t>;

/// `join_leaves`: subtrees of at most max_leaf_size primitives of one kind may become leaves, where their references are
/// adjacent.
[[nodiscard]] Cuts find_cuts(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, int threads);

[[nodiscard]] inline std::uint32_t left_places(std::uint32_t cut, std::uint32_t places) noexcept {
    return cut >> (4 * (places - 1)) & 15u;
}
[[nodiscard]] inline bool is_leaf(std::uint32_t cut) noexcept { return (cut & 15u) != 0; }

} // namespace lanecast
