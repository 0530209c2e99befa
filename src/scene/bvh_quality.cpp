#include "scene/bvh_quality.hpp"

#include <algorithm>
#include <cstring>

namespace lanecast {
namespace {

struct Sums {
    double node_area = 0, test_area = 0;
    std::uint32_t overlapping = 0;
};

double half_area(const BvhNode& node, int i) {
    const double x = double{node.hi[0][i]} - double{node.lo[0][i]}, y = double{node.hi[1][i]} - double{node.lo[1][i]},
                 z = double{node.hi[2][i]} - double{node.lo[2][i]};
    return x * y + y * z + z * x;
}

bool is_used(const BvhNode& node, int i) { return node.lo[0][i] <= node.hi[0][i]; }

const BvhNode& node_at(const unsigned char* arena, std::uint64_t offset) {
    return *reinterpret_cast<const BvhNode*>(arena + offset * 64);
}

/// Depth first: at most max_bvh_depth calls deep.
void add_subtree(const unsigned char* arena, const BvhNode& node, int level, Sums& sums, BvhQuality& quality) {
    ++quality.nodes;
    quality.depth = std::max(quality.depth, level);
    if (children_overlap(node)) ++sums.overlapping;
    for (int i = 0; i < 8; ++i) {
        if (!is_used(node, i)) continue;
        const double area = half_area(node, i);
        if ((node.child[i] & child_is_leaf) == 0) {
            sums.node_area += area;
            add_subtree(arena, node_at(arena, node.child[i]), level + 1, sums, quality);
            continue;
        }
        const auto count = static_cast<std::uint32_t>(node.child[i] >> child_count_shift & child_count_mask) + 1;
        sums.test_area += area * count;
        ++quality.leaves;
        ++quality.leaf_sizes[count];
    }
}

double root_area(const BvhNode& root) {
    float lo[3], hi[3];
    for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = *std::min_element(root.lo[axis], root.lo[axis] + 8);
        hi[axis] = *std::max_element(root.hi[axis], root.hi[axis] + 8);
    }
    const double x = double{hi[0]} - double{lo[0]}, y = double{hi[1]} - double{lo[1]}, z = double{hi[2]} - double{lo[2]};
    return x * y + y * z + z * x;
}

} // namespace

bool children_overlap(const BvhNode& node) {
    for (int i = 0; i < 8; ++i) {
        if (!is_used(node, i)) continue;
        // Share of box i and of box j that lies in both, eight j at a time. The smaller box has the larger share.
        float share_i[8], share_j[8];
        std::fill_n(share_i, 8, 1.0f);
        std::fill_n(share_j, 8, 1.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const float lo_i = node.lo[axis][i], hi_i = node.hi[axis][i], length_i = hi_i - lo_i;
            for (int j = 0; j < 8; ++j) {
                const float length_j = node.hi[axis][j] - node.lo[axis][j];
                const float common = std::min(hi_i, node.hi[axis][j]) - std::max(lo_i, node.lo[axis][j]);
                const float flat_share = common >= 0 ? 1.0f : 0.0f, inside = common > 0 ? common : 0.0f;
                share_i[j] *= length_i > 0 ? inside / length_i : flat_share;
                share_j[j] *= length_j > 0 ? inside / length_j : flat_share;
            }
        }
        for (int j = 0; j < 8; ++j)
            if (j != i && is_used(node, j) && std::max(share_i[j], share_j[j]) > 0.5f) return true;
    }
    return false;
}

BvhQuality measure_quality(const unsigned char* arena) {
    BvhQuality quality;
    if (arena == nullptr) return quality;
    const BvhNode& root = node_at(arena, 0);
    Sums sums;
    add_subtree(arena, root, 1, sums, quality);
    const double whole = root_area(root);
    quality.sah_cost = whole > 0 ? (whole + sums.node_area + sums.test_area) / whole : 0;
    quality.overlapping_share = static_cast<double>(sums.overlapping) / quality.nodes;
    return quality;
}

} // namespace lanecast
