#pragma once
// The eight-wide tree and where its parts will lie in the arena.

#include "scene/bvh_binary.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lanecast {

struct WideNode {
    std::uint32_t offset;   ///< in the arena, in units of 64 bytes
    std::uint32_t count;    ///< of children
    std::uint32_t child[8]; ///< binary nodes
    std::uint32_t place[8]; ///< offset in the arena of the child's node or of its triangle block; of other leaves 0
    std::uint32_t slot[8];  ///< of a leaf: its first primitive
    std::uint32_t leaf[8];  ///< of a leaf: its index in arena order
};

struct WideTree {
    std::vector<WideNode> nodes; ///< in arena order
    std::size_t arena_units = 0; ///< of 64 bytes
    std::uint32_t leaves = 0;
    int depth = 0; ///< levels of nodes
};

/// Units of 64 bytes that a block of n triangles takes: 9 rows of n floats.
[[nodiscard]] constexpr std::uint32_t block_units(std::uint32_t n) noexcept { return (36 * n + 63) / 64; }

/// Opens, until a node has eight children, the inner child with the largest area. Arena order is depth first: a node, the blocks
/// of its leaves, its inner children. Slots count up in the same order within each kind, from first_slot[kind].
[[nodiscard]] WideTree collapse(const BinaryTree& tree, const BuildRef* refs, const std::uint32_t* first_slot);

} // namespace lanecast
