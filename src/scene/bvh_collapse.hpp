#pragma once
// The eight-wide tree and where its parts will lie in the arena.

#include "scene/bvh_binary.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lanecast {

struct WideNode {
    std::uint32_t offset;       ///< in the arena, in units of 64 bytes
    std::uint32_t count;        ///< of children
    std::uint32_t leaves;       ///< bit i: child i is a leaf
    std::uint32_t kinds;        ///< of leaves: PrimitiveKind of child i from bit 4 i on
    std::uint32_t child[8];     ///< binary nodes
    std::uint32_t place[8];     ///< offset in the arena of the child's node or of its triangle block; of other leaves 0
    std::uint32_t reference[8]; ///< of a leaf: its first primitive, counted in arena order within its kind
    std::uint32_t leaf[8];      ///< of a leaf: its index in arena order
};

/// Sizes, or where something begins.
struct WideExtent {
    std::uint32_t units = 0; ///< of 64 bytes of the arena
    std::uint32_t nodes = 0, leaves = 0;
    std::uint32_t references[primitive_kind_count] = {};
};

/// Nodes that lie together, in arena order. Offsets and numbers count from `begin`, but for `place` of inner children elsewhere.
struct WidePiece {
    std::vector<WideNode> nodes;
    WideExtent begin, size;
    std::uint32_t root = 0; ///< binary node
};

struct WideTree {
    std::vector<WidePiece> pieces; ///< in arena order
    WideExtent size;
};

inline constexpr std::uint64_t largest_arena = std::uint64_t{1} << 31; ///< bytes: what child_block_shift leaves room for

/// Units of 64 bytes that a block of n triangles takes: 9 rows of n floats.
[[nodiscard]] constexpr std::uint32_t block_units(std::uint32_t n) noexcept { return (36 * n + 63) / 64; }

/// The choice of children that bvh_cut finds. Arena order is depth first: a node, the blocks of its leaves, its inner children.
/// Throws Error (memory) where the arena would exceed 2 GiB.
[[nodiscard]] WideTree collapse(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, int threads);

} // namespace lanecast
