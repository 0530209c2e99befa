#include "scene/bvh_quality.hpp"

#include "scene/parallel.hpp"

#include <algorithm>
#include <cstring>

namespace lanecast {
namespace {

constexpr std::size_t piece = 2048; ///< nodes per partial sum: fixed, so the sum does not depend on the threads

struct Part {
    double node_area = 0, test_area = 0;
    std::uint32_t leaves = 0, overlapping = 0;
    std::uint32_t leaf_sizes[max_leaf_size + 1] = {};
};

double half_area(const BvhNode& node, int i) {
    const double x = double{node.hi[0][i]} - double{node.lo[0][i]}, y = double{node.hi[1][i]} - double{node.lo[1][i]},
                 z = double{node.hi[2][i]} - double{node.lo[2][i]};
    return x * y + y * z + z * x;
}

bool is_used(const BvhNode& node, int i) { return node.lo[0][i] <= node.hi[0][i]; }

void add(Part& part, const BvhNode& node) {
    for (int i = 0; i < 8; ++i) {
        if (!is_used(node, i)) continue;
        const double area = half_area(node, i);
        if ((node.child[i] & child_is_leaf) == 0) {
            part.node_area += area;
            continue;
        }
        const auto count = static_cast<std::uint32_t>(node.child[i] >> child_count_shift & child_count_mask) + 1;
        part.test_area += area * count;
        ++part.leaves;
        ++part.leaf_sizes[count];
    }
    if (children_overlap(node)) ++part.overlapping;
}

const BvhNode& node_at(const unsigned char* arena, std::uint32_t offset) {
    return *reinterpret_cast<const BvhNode*>(arena + std::size_t{offset} * 64);
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

BvhQuality measure_quality(const unsigned char* arena, const std::vector<std::uint32_t>& node_offsets, int depth, int threads) {
    BvhQuality quality;
    quality.nodes = static_cast<std::uint32_t>(node_offsets.size());
    quality.depth = depth;
    if (node_offsets.empty()) return quality;
    std::vector<Part> parts(piece_count(node_offsets.size(), piece));
    parallel_for(threads, parts.size(), [&](std::size_t p) {
        for (std::size_t i = p * piece; i < std::min(node_offsets.size(), (p + 1) * piece); ++i)
            add(parts[p], node_at(arena, node_offsets[i]));
    });
    const double whole = root_area(node_at(arena, 0));
    double node_area = whole, test_area = 0;
    std::uint32_t overlapping = 0;
    for (const Part& part : parts) {
        node_area += part.node_area;
        test_area += part.test_area;
        overlapping += part.overlapping;
        quality.leaves += part.leaves;
        for (int i = 0; i <= max_leaf_size; ++i) quality.leaf_sizes[i] += part.leaf_sizes[i];
    }
    quality.sah_cost = whole > 0 ? (node_area + test_area) / whole : 0;
    quality.overlapping_share = static_cast<double>(overlapping) / static_cast<double>(node_offsets.size());
    return quality;
}

} // namespace lanecast
