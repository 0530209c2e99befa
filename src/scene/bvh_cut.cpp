#include "scene/bvh_cut.hpp"

#include "scene/parallel.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace lanecast {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t task_size = 8192; ///< subtrees of fewer primitives are one thread's

// Expected work of a ray, per area of a box that it enters. Measured: docs/bvh.md.
constexpr float node_cost = 1, leaf_cost = 1, primitive_cost = 0.1f;

/// Cost of a subtree that may take i + 1 places; more never cost more. The last is infinite: nobody gets eight but a node's root.
struct Costs {
    float of[8];
};

class CutFinder {
public:
    CutFinder(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, std::uint32_t* cuts)
        : nodes_(tree.nodes.get()), refs_(refs), join_leaves_(join_leaves), cuts_(cuts) {}

    void run(int threads) {
        std::vector<std::uint32_t> roots;
        list_tasks(0, roots);
        std::vector<Costs> costs(roots.size());
        parallel_for(threads, roots.size(), [&](std::size_t i) { costs[i] = solve(roots[i]); });
        std::size_t next = 0;
        solve_top(0, costs, next);
    }

private:
    void list_tasks(std::uint32_t index, std::vector<std::uint32_t>& roots) const {
        const BinaryNode& node = nodes_[index];
        if (node.count < task_size || is_leaf(node)) return roots.push_back(index);
        list_tasks(node.children, roots);
        list_tasks(node.children + 1, roots);
    }

    Costs solve_top(std::uint32_t index, const std::vector<Costs>& costs, std::size_t& next) {
        const BinaryNode& node = nodes_[index];
        if (node.count < task_size || is_leaf(node)) return costs[next++];
        const Costs left = solve_top(node.children, costs, next);
        const Costs right = solve_top(node.children + 1, costs, next);
        return merge(index, left, right);
    }

    Costs solve(std::uint32_t index) {
        const BinaryNode& node = nodes_[index];
        if (is_leaf(node)) {
            cuts_[index] = 1;
            Costs costs;
            std::fill_n(costs.of, 7, cost_as_leaf(node));
            costs.of[7] = infinity;
            return costs;
        }
        const Costs left = solve(node.children);
        const Costs right = solve(node.children + 1);
        return merge(index, left, right);
    }

    Costs merge(std::uint32_t index, const Costs& left, const Costs& right) {
        float best[8]; // of j + 1 places: the cheapest of left k and right j + 1 - k
        std::int32_t from[8];
        float padded[16];
        std::fill_n(padded, 8, infinity);
        std::copy_n(right.of, 8, padded + 8);
        std::fill_n(best, 8, infinity);
        std::fill_n(from, 8, 0);
        for (int k = 1; k <= 7; ++k) {
            const float l = left.of[k - 1];
            const float* const r = padded + 8 - k; // [j]: right with j + 1 - k places
            for (int j = 0; j < 8; ++j) {
                const float c = l + r[j];
                from[j] = c < best[j] ? k : from[j];
                best[j] = c < best[j] ? c : best[j];
            }
        }
        const BinaryNode& node = nodes_[index];
        float single = node.area * node_cost + best[7];
        std::uint32_t cut = static_cast<std::uint32_t>(from[7]) << 28;
        if (join_leaves_ && may_be_leaf(node)) {
            const float leaf = cost_as_leaf(node);
            if (leaf <= single) single = leaf, cut |= 1;
        }
        // The halves share all places that are allowed.
        Costs costs;
        costs.of[0] = single;
        for (std::uint32_t i = 1; i < 7; ++i) {
            if (best[i] < single) cut |= static_cast<std::uint32_t>(from[i]) << (4 * i);
            costs.of[i] = std::min(best[i], single);
        }
        costs.of[7] = infinity;
        cuts_[index] = cut;
        return costs;
    }

    /// Eight triangles take little longer than one; quadrics are met one by one.
    [[nodiscard]] float cost_as_leaf(const BinaryNode& node) const {
        const auto count = static_cast<float>(node.count);
        const bool together = kind_of(refs_[node.first]) == static_cast<std::uint32_t>(PrimitiveKind::triangle);
        return node.area * (together ? leaf_cost + primitive_cost * count : leaf_cost * count);
    }

    bool may_be_leaf(const BinaryNode& node) const {
        if (node.count > static_cast<std::uint32_t>(max_leaf_size)) return false;
        for (std::uint32_t i = 1; i < node.count; ++i)
            if (kind_of(refs_[node.first + i]) != kind_of(refs_[node.first])) return false;
        return true;
    }

    const BinaryNode* nodes_;
    const BuildRef* refs_;
    bool join_leaves_;
    std::uint32_t* cuts_;
};

} // namespace

Cuts find_cuts(const BinaryTree& tree, const BuildRef* refs, bool join_leaves, int threads) {
    Cuts cuts = make_scratch<std::uint32_t>(tree.node_count);
    CutFinder(tree, refs, join_leaves, cuts.get()).run(threads);
    return cuts;
}

} // namespace lanecast
