#include "cli/selftest/leaf_tree.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <vector>

namespace lanecast::selftest {
namespace {

struct Item {
    float lo[3], hi[3];
    PrimitiveKind kind;
    std::vector<std::uint32_t> slots; ///< of the old scene
};

void include(Item& box, const Item& other) {
    for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], other.lo[axis]);
        box.hi[axis] = std::max(box.hi[axis], other.hi[axis]);
    }
}

std::uint32_t count_of(std::uint64_t leaf) {
    return static_cast<std::uint32_t>(leaf >> child_count_shift & child_count_mask) + 1;
}

const float* corner_row(const SceneArrays& arrays, std::uint32_t slot, std::uint32_t row) {
    const std::uint32_t block = arrays.triangles[slot].block, n = (block >> 3 & 7u) + 1;
    return reinterpret_cast<const float*>(arrays.arena.get() + std::size_t{block >> 6} * 64) + row * n + (block & 7u);
}

Item triangle_item(const SceneArrays& arrays, std::uint32_t slot) {
    Item item{{}, {}, PrimitiveKind::triangle, {slot}};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const float a = *corner_row(arrays, slot, axis), b = *corner_row(arrays, slot, 3 + axis);
        const float c = *corner_row(arrays, slot, 6 + axis);
        item.lo[axis] = std::min({a, b, c});
        item.hi[axis] = std::max({a, b, c});
    }
    return item;
}

void list_items(const SceneArrays& arrays, std::uint64_t node_word, std::vector<Item>& items) {
    const auto& node = *reinterpret_cast<const BvhNode*>(arrays.arena.get() + node_word * 64);
    for (int i = 0; i < 8; ++i) {
        const std::uint64_t child = node.child[i];
        if (child == 0) continue; // no child is the root
        if ((child & child_is_leaf) == 0) {
            list_items(arrays, child, items);
            continue;
        }
        const auto kind = static_cast<PrimitiveKind>(child >> child_kind_shift & child_kind_mask);
        const auto first = static_cast<std::uint32_t>(child);
        if (kind == PrimitiveKind::triangle) {
            for (std::uint32_t k = 0; k < count_of(child); ++k) items.push_back(triangle_item(arrays, first + k));
            continue;
        }
        for (std::uint32_t k = 0; k < count_of(child); ++k) { // quadrics of one leaf: each in the box of all
            Item item{{}, {}, kind, {first + k}};
            for (int axis = 0; axis < 3; ++axis) item.lo[axis] = node.lo[axis][i], item.hi[axis] = node.hi[axis][i];
            items.push_back(item);
        }
    }
}

/// Halves along the longest side until a part is one leaf; halves hold whole leaves.
void make_leaves(Item* items, std::size_t count, std::size_t leaf_size, std::vector<Item>& leaves) {
    Item all = items[0];
    for (std::size_t i = 1; i < count; ++i) include(all, items[i]);
    if (count <= leaf_size) {
        all.slots.clear();
        for (std::size_t i = 0; i < count; ++i) all.slots.insert(all.slots.end(), items[i].slots.begin(), items[i].slots.end());
        leaves.push_back(all);
        return;
    }
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (all.hi[axis] - all.lo[axis] > all.hi[longest] - all.lo[longest]) longest = axis;
    const std::size_t half = (count / 2 + leaf_size - 1) / leaf_size * leaf_size;
    std::nth_element(items, items + half, items + count,
                     [&](const Item& a, const Item& b) { return a.lo[longest] + a.hi[longest] < b.lo[longest] + b.hi[longest]; });
    make_leaves(items, half, leaf_size, leaves);
    make_leaves(items + half, count - half, leaf_size, leaves);
}

std::size_t block_bytes(std::size_t n) { return (36 * n + 63) / 64 * 64; }

class Writer {
public:
    Writer(const SceneArrays& from, SceneArrays& to) : from_(from), to_(to) {
        std::copy(std::begin(from.first_slot), std::end(from.first_slot), next_);
    }

    /// Eight parts of the range each; a single leaf is the only child of the root.
    std::uint64_t node(const Item* leaves, std::size_t count) {
        const std::size_t offset = bytes_;
        bytes_ += sizeof(BvhNode);
        BvhNode node{};
        for (auto& row : node.lo) std::fill(std::begin(row), std::end(row), 1e30f);
        for (auto& row : node.hi) std::fill(std::begin(row), std::end(row), -1e30f);
        const std::size_t parts = std::min<std::size_t>(count, 8);
        for (std::size_t i = 0; i < parts; ++i) {
            const std::size_t begin = i * count / parts, end = (i + 1) * count / parts;
            Item box = leaves[begin];
            for (std::size_t k = begin + 1; k < end; ++k) include(box, leaves[k]);
            for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = box.lo[axis], node.hi[axis][i] = box.hi[axis];
            node.child[i] = end - begin == 1 ? leaf(leaves[begin]) : this->node(leaves + begin, end - begin);
        }
        ::new (to_.arena.get() + offset) BvhNode(node);
        return offset / 64;
    }

private:
    std::uint64_t leaf(const Item& item) {
        const auto n = static_cast<std::uint32_t>(item.slots.size());
        const auto kind = static_cast<std::uint32_t>(item.kind);
        const std::uint32_t first = next_[kind];
        next_[kind] += n;
        std::uint64_t block = 0;
        if (item.kind == PrimitiveKind::triangle) {
            block = bytes_ / 64;
            auto* const rows = reinterpret_cast<float*>(to_.arena.get() + bytes_);
            std::memset(rows, 0, block_bytes(n));
            bytes_ += block_bytes(n);
            for (std::uint32_t lane = 0; lane < n; ++lane) {
                for (std::uint32_t row = 0; row < 9; ++row) rows[row * n + lane] = *corner_row(from_, item.slots[lane], row);
                to_.triangles[first + lane] = from_.triangles[item.slots[lane]];
                to_.triangles[first + lane].block = static_cast<std::uint32_t>(block) << 6 | (n - 1) << 3 | lane;
            }
        }
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t old = item.slots[k];
            to_.scene_id[first + k] = from_.scene_id[old];
            to_.object[first + k] = from_.object[old];
            to_.material[first + k] = from_.material[old];
            if (item.kind == PrimitiveKind::sphere) {
                to_.spheres[first + k - from_.first_slot[1]] = from_.spheres[old - from_.first_slot[1]];
            } else if (item.kind != PrimitiveKind::triangle) {
                to_.affines[first + k - from_.first_slot[2]] = from_.affines[old - from_.first_slot[2]];
                to_.affine_shading[first + k - from_.first_slot[2]] = from_.affine_shading[old - from_.first_slot[2]];
            }
        }
        to_.leaves.push_back(child_is_leaf | std::uint64_t{kind} << child_kind_shift | std::uint64_t{n - 1} << child_count_shift |
                             block << child_block_shift | first);
        return to_.leaves.back();
    }

    const SceneArrays& from_;
    SceneArrays& to_;
    std::size_t bytes_ = 0;
    std::uint32_t next_[primitive_kind_count + 1];
};

} // namespace

SceneArrays with_leaves_of(const SceneArrays& arrays, int leaf_size) {
    std::vector<Item> items, leaves;
    if (!arrays.leaves.empty()) list_items(arrays, 0, items);
    std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.kind < b.kind; });
    for (std::size_t begin = 0; begin < items.size();) {
        std::size_t end = begin;
        while (end < items.size() && items[end].kind == items[begin].kind) ++end;
        make_leaves(items.data() + begin, end - begin, static_cast<std::size_t>(leaf_size), leaves);
        begin = end;
    }
    SceneArrays to;
    to.triangles.resize(arrays.triangles.size());
    to.spheres.resize(arrays.spheres.size());
    to.affines.resize(arrays.affines.size());
    to.affine_shading.resize(arrays.affine_shading.size());
    to.planes = arrays.planes;
    to.scene_id = arrays.scene_id, to.object = arrays.object, to.material = arrays.material;
    to.materials = arrays.materials;
    to.lights = arrays.lights;
    std::copy(std::begin(arrays.first_slot), std::end(arrays.first_slot), to.first_slot);
    to.features = arrays.features;
    std::copy(std::begin(arrays.ambient), std::end(arrays.ambient), to.ambient);
    std::copy(std::begin(arrays.background), std::end(arrays.background), to.background);
    to.max_coordinate = arrays.max_coordinate;
    to.normalisation = arrays.normalisation;
    to.bounds_min = arrays.bounds_min, to.bounds_max = arrays.bounds_max;
    if (leaves.empty()) return to;
    std::size_t blocks = 0;
    for (const Item& leaf : leaves) blocks += leaf.kind == PrimitiveKind::triangle ? block_bytes(leaf.slots.size()) : 0;
    to.arena_bytes = leaves.size() * sizeof(BvhNode) + sizeof(BvhNode) + blocks; // fewer nodes than leaves, but for a lone one
    to.arena = make_paged_bytes(to.arena_bytes);
    std::memset(to.arena.get(), 0, to.arena_bytes);
    static_cast<void>(Writer(arrays, to).node(leaves.data(), leaves.size()));
    return to;
}

} // namespace lanecast::selftest
