#pragma once
// Which nodes of the binary tree become children of eight-wide ones: the cheapest choice, by dynamic programming (Wald, Benthin
// and Boulos 2008; Ylitie, Karras and Laine 2017).

#include "scene/bvh_binary.hpp"
#include "scene/scratch.hpp"

#include <cstdint>

namespace lanecast {

/// Per binary node, in nibbles. The lowest: what the subtree becomes as one child, a leaf (1) or a wide node of 2 to 8 children,
/// the highest then being how many of them come from the left half. Between, for 2 to 7 places that it may take in the node
/// above: how many of them the left half gets; 0: it is one child.
using Cuts = Scratch<std::uint32_t>;

/// `join_leaves`: subtrees of at most max_leaf_size primitives of one kind may become leaves, where their references are
/// adjacent.
[[nodiscard]] Cuts find_cuts(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, int threads);

inline constexpr std::uint32_t one_leaf = 1;
[[nodiscard]] inline bool is_leaf(std::uint32_t cut) noexcept { return (cut & 15u) == one_leaf; }
[[nodiscard]] inline std::uint32_t child_count(std::uint32_t cut) noexcept { return cut & 15u; }
[[nodiscard]] inline std::uint32_t left_children(std::uint32_t cut) noexcept { return cut >> 28; }
/// places: 2 to 7
[[nodiscard]] inline std::uint32_t left_places(std::uint32_t cut, std::uint32_t places) noexcept {
    return cut >> (4 * (places - 1)) & 15u;
}

} // namespace lanecast
