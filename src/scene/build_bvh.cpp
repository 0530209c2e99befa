#include "scene/build_bvh.hpp"

#include "scene/bvh_binary.hpp"
#include "scene/bvh_collapse.hpp"
#include "scene/bvh_quality.hpp"
#include "scene/error.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace lanecast {
namespace {

constexpr std::size_t largest_arena = std::size_t{1} << 31; ///< what child_block_shift leaves room for

std::uint64_t leaf_word(const BinaryNode& leaf, std::uint32_t kind, std::uint32_t block, std::uint32_t slot) {
    return child_is_leaf | std::uint64_t{kind} << child_kind_shift | std::uint64_t{leaf.count - 1} << child_count_shift |
           std::uint64_t{block} << child_block_shift | slot;
}

/// Writes a node and lists its leaves.
void emit_node(const WideNode& wide, const BinaryTree& binary, const BuildRef* refs, BvhTree& tree) {
    BvhNode& node = *::new (tree.arena.get() + std::size_t{wide.offset} * 64) BvhNode;
    for (std::uint32_t i = 0; i < 8; ++i) {
        if (i >= wide.count) {
            for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = 1e30f, node.hi[axis][i] = -1e30f;
            node.child[i] = 0;
            continue;
        }
        const BinaryNode& child = binary.nodes[wide.child[i]];
        for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = child.lo[axis], node.hi[axis][i] = child.hi[axis];
        if (!is_leaf(child)) {
            node.child[i] = wide.place[i];
            continue;
        }
        node.child[i] = leaf_word(child, kind_of(refs[child.first]), wide.place[i], wide.slot[i]);
        tree.leaves[wide.leaf[i]] = node.child[i];
        tree.leaf_first_ref[wide.leaf[i]] = child.first;
    }
}

} // namespace

BvhTree build_bvh(BuildRef* refs, std::size_t count, const std::uint32_t* first_slot, int threads) {
    BvhTree tree;
    if (count == 0) return tree;
    if (count >= largest_arena / 36) throw Error(ExitCode::memory, "the scene has too many primitives for a tree of 2 GiB");
    const BinaryTree binary = build_binary(refs, count, threads);
    const WideTree wide = collapse(binary, refs, first_slot);
    tree.arena_bytes = wide.arena_units * 64;
    if (tree.arena_bytes > largest_arena) throw Error(ExitCode::memory, "the tree would exceed 2 GiB");
    tree.arena = make_aligned_bytes(tree.arena_bytes);
    tree.leaves.resize(wide.leaves);
    tree.leaf_first_ref.resize(wide.leaves);

    constexpr std::size_t piece = 1024;
    parallel_for(threads, piece_count(wide.nodes.size(), piece), [&](std::size_t p) {
        for (std::size_t i = p * piece; i < std::min(wide.nodes.size(), (p + 1) * piece); ++i)
            emit_node(wide.nodes[i], binary, refs, tree);
    });

    std::vector<std::uint32_t> offsets(wide.nodes.size());
    for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = wide.nodes[i].offset;
    tree.quality = measure_quality(tree.arena.get(), offsets, wide.depth, threads);
    for (int axis = 0; axis < 3; ++axis)
        tree.max_coordinate =
            std::max({tree.max_coordinate, std::abs(binary.nodes[0].lo[axis]), std::abs(binary.nodes[0].hi[axis])});
    return tree;
}

} // namespace lanecast
