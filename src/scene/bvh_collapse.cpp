#include "scene/bvh_collapse.hpp"

#include <algorithm>

namespace lanecast {
namespace {

class Collapse {
public:
    Collapse(const BinaryTree& tree, const BuildRef* refs, const std::uint32_t* first_slot)
        : nodes_(tree.nodes.get()), refs_(refs) {
        std::copy_n(first_slot, primitive_kind_count, next_slot_);
    }

    WideTree run() {
        place(0, 1);
        return std::move(result_);
    }

private:
    /// Returns the node's offset.
    std::uint32_t place(std::uint32_t root, int level) {
        result_.depth = std::max(result_.depth, level);
        const auto offset = static_cast<std::uint32_t>(result_.arena_units);
        const std::size_t index = result_.nodes.size();
        WideNode wide{};
        wide.offset = offset;
        open_children(root, wide);
        result_.arena_units += sizeof(BvhNode) / 64;
        for (std::uint32_t i = 0; i < wide.count; ++i)
            if (const BinaryNode& child = nodes_[wide.child[i]]; is_leaf(child)) place_leaf(child, wide, i);
        result_.nodes.push_back(wide);
        for (std::uint32_t i = 0; i < wide.count; ++i)
            if (!is_leaf(nodes_[wide.child[i]])) {
                const std::uint32_t inner = place(wide.child[i], level + 1);
                result_.nodes[index].place[i] = inner;
            }
        return offset;
    }

    void open_children(std::uint32_t root, WideNode& wide) const {
        wide.child[0] = root; // a single leaf is the only child of its node
        wide.count = 1;
        std::uint32_t opened = 0;
        while (wide.count < 8) {
            float largest = -1;
            for (std::uint32_t i = 0; i < wide.count; ++i)
                if (const BinaryNode& node = nodes_[wide.child[i]]; !is_leaf(node) && node.area > largest)
                    largest = node.area, opened = i;
            if (largest < 0) return;
            const std::uint32_t children = nodes_[wide.child[opened]].children;
            std::copy_backward(wide.child + opened + 1, wide.child + wide.count, wide.child + wide.count + 1);
            wide.child[opened] = children;
            wide.child[opened + 1] = children + 1;
            ++wide.count;
        }
    }

    void place_leaf(const BinaryNode& leaf, WideNode& wide, std::uint32_t i) {
        const std::uint32_t kind = kind_of(refs_[leaf.first]);
        wide.slot[i] = next_slot_[kind];
        next_slot_[kind] += leaf.count;
        wide.leaf[i] = result_.leaves++;
        if (kind != static_cast<std::uint32_t>(PrimitiveKind::triangle)) return;
        wide.place[i] = static_cast<std::uint32_t>(result_.arena_units);
        result_.arena_units += block_units(leaf.count);
    }

    const BinaryNode* nodes_;
    const BuildRef* refs_;
    std::uint32_t next_slot_[primitive_kind_count];
    WideTree result_;
};

} // namespace

WideTree collapse(const BinaryTree& tree, const BuildRef* refs, const std::uint32_t* first_slot) {
    return Collapse(tree, refs, first_slot).run();
}

} // namespace lanecast
