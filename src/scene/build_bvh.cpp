#include "scene/build_bvh.hpp"

#include "scene/bvh_binary.hpp"
#include "scene/bvh_collapse.hpp"
#include "scene/error.hpp"
#include "scene/parallel.hpp"
#include "scene/scratch.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace lanecast {
namespace {

std::uint64_t leaf_word(const BinaryNode& leaf, std::uint32_t kind, std::uint32_t block, std::uint32_t reference) {
    return child_is_leaf | std::uint64_t{kind} << child_kind_shift | std::uint64_t{leaf.count - 1} << child_count_shift |
           std::uint64_t{block} << child_block_shift | reference;
}

struct Emission {
    const BinaryTree& binary;
    const std::uint32_t* first_slot;
    BvhTree& tree;
};

/// Writes a node and lists its leaves.
void emit_node(const Emission& out, const WidePiece& piece, const WideNode& wide) {
    const WideExtent& begin = piece.begin;
    BvhNode& node = *::new (out.tree.arena.get() + std::size_t{begin.units + wide.offset} * 64) BvhNode;
    for (std::uint32_t i = 0; i < 8; ++i) {
        if (i >= wide.count) {
            for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = 1e30f, node.hi[axis][i] = -1e30f;
            node.child[i] = 0;
            continue;
        }
        const BinaryNode& child = out.binary.nodes[wide.child[i]];
        for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = child.lo[axis], node.hi[axis][i] = child.hi[axis];
        if ((wide.leaves >> i & 1u) == 0) {
            node.child[i] = begin.units + wide.place[i];
            continue;
        }
        const std::uint32_t kind = wide.kinds >> (4 * i) & 15u;
        const bool is_shared = kind == leaf_of_shared;
        const bool has_block = is_shared || kind == static_cast<std::uint32_t>(PrimitiveKind::triangle);
        const std::uint32_t first =
            is_shared ? wide.reference[i] : out.first_slot[kind] + begin.references[kind] + wide.reference[i];
        node.child[i] = leaf_word(child, kind, has_block ? begin.units + wide.place[i] : 0, first);
        const std::uint32_t leaf = begin.leaves + wide.leaf[i];
        out.tree.leaves[leaf] = node.child[i];
        out.tree.leaf_first_ref[leaf] = child.first;
    }
}

/// Where triangles may stand in several leaves: slots in the order of first appearance. Leaves in which all appear first stay as
/// they are, the others become leaves of shared triangles.
void number_shared(const BinaryTree& binary, const BuildRef* refs, const SpatialRoom& spatial, WideTree& wide,
                   std::vector<std::uint32_t>& shared_slots) {
    constexpr std::uint32_t none = 0xffffffffu;
    const Scratch<std::uint32_t> slot_of = make_scratch<std::uint32_t>(spatial.primitives);
    std::fill_n(slot_of.get(), spatial.primitives, none);
    std::uint32_t next = 0;
    const auto number_leaf = [&](WideNode& node, std::uint32_t i) {
        const BinaryNode& leaf = binary.nodes[node.child[i]];
        std::uint32_t slots[max_leaf_size];
        const std::uint32_t first = next;
        for (std::uint32_t k = 0; k < leaf.count; ++k) {
            std::uint32_t& slot = slot_of[spatial.index_of(refs[leaf.first + k])];
            slots[k] = slot == none ? next | first_here : slot;
            if (slot == none) slot = next++;
        }
        node.reference[i] = first;
        if (next - first == leaf.count) return;
        node.reference[i] = static_cast<std::uint32_t>(shared_slots.size());
        node.kinds |= leaf_of_shared << (4 * i);
        shared_slots.insert(shared_slots.end(), slots, slots + leaf.count);
    };
    for (WidePiece& piece : wide.pieces) {
        piece.begin.references[static_cast<int>(PrimitiveKind::triangle)] = 0;
        for (WideNode& node : piece.nodes)
            for (std::uint32_t i = 0; i < node.count; ++i)
                if ((node.leaves >> i & 1u) != 0 && (node.kinds >> (4 * i) & 15u) == 0) number_leaf(node, i);
    }
}

} // namespace

BvhTree build_bvh(BuildRef* refs, std::size_t count, const std::uint32_t* first_slot, const SpatialRoom* spatial, int threads) {
    BvhTree tree;
    if (count == 0) return tree;
    if (count >= largest_arena / 36) throw Error(ExitCode::memory, "the scene has too many primitives for a tree of 2 GiB");
    const BinaryTree binary = build_binary(refs, count, spatial, threads);
    WideTree wide = collapse(binary, refs, spatial != nullptr, threads);
    if (spatial != nullptr) number_shared(binary, refs, *spatial, wide, tree.shared_slots);
    tree.arena_bytes = std::size_t{wide.size.units} * 64;
    tree.arena = make_paged_bytes(tree.arena_bytes);
    tree.leaves.resize(wide.size.leaves);
    tree.leaf_first_ref.resize(wide.size.leaves);

    parallel_for(threads, wide.pieces.size(), [&](std::size_t p) {
        for (const WideNode& node : wide.pieces[p].nodes) emit_node({binary, first_slot, tree}, wide.pieces[p], node);
    });
    for (int axis = 0; axis < 3; ++axis)
        tree.max_coordinate =
            std::max({tree.max_coordinate, std::abs(binary.nodes[0].lo[axis]), std::abs(binary.nodes[0].hi[axis])});
    return tree;
}

} // namespace lanecast
