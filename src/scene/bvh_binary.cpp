#include "scene/bvh_binary.hpp"

#include "scene/bvh_split.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <vector>

namespace lanecast {
namespace {

constexpr std::uint32_t task_size = 8192;                ///< ranges from this size on may go to another thread
constexpr std::uint32_t node_chunk = 1024;               ///< nodes that a thread takes at a time
constexpr std::uint32_t keep_together = 16;              ///< references of smaller ranges stay adjacent
constexpr std::uint32_t small_nodes = 2 * max_leaf_size; ///< at most needed below a range that may become a leaf

constexpr float least_overlap = 1e-5f; ///< of the root's area: Stich, Friedrich and Dietrich's alpha

struct Task {
    std::uint32_t node = 0;
    BuildRange range;
    int depth = 0; ///< inner nodes above
};

/// Tasks in the order they were made, so the largest first. Empty and nobody at work: the tree is done.
class TaskQueue {
public:
    void push(const Task& task) {
        {
            const std::lock_guard lock(mutex_);
            tasks_.push_back(task);
        }
        changed_.notify_one();
    }
    /// Call again to report the last task as done. False: no more will come.
    [[nodiscard]] bool pop(Task& task, bool& working) {
        std::unique_lock lock(mutex_);
        if (working && --workers_ == 0 && next_ == tasks_.size()) changed_.notify_all();
        working = false;
        changed_.wait(lock, [&] { return aborted_ || next_ < tasks_.size() || workers_ == 0; });
        if (aborted_ || next_ == tasks_.size()) return false;
        task = tasks_[next_++];
        ++workers_;
        return working = true;
    }

    /// A worker failed: nobody waits for what it would have pushed.
    void abort() {
        const std::lock_guard lock(mutex_);
        aborted_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool aborted_ = false;
    std::vector<Task> tasks_;
    std::size_t next_ = 0;
    int workers_ = 0;
};

/// Nodes a thread owns and has not yet used.
struct NodeCursor {
    std::uint32_t next = 0, end = 0;
};

class Builder {
public:
    Builder(BuildRef* refs, std::size_t count, const SpatialRoom* spatial, int threads)
        : refs_(refs), count_(static_cast<std::uint32_t>(count)),
          capacity_(spatial != nullptr ? static_cast<std::uint32_t>(spatial->capacity) : count_), threads_(threads) {
        if (spatial != nullptr) spatial_.corners_of = spatial->corners_of, is_spatial_ = true;
        count = capacity_;
        // Untouched pages cost nothing. Every chunk but a thread's last is used but for small_nodes.
        const std::size_t used = 2 * count + 2 * count / (node_chunk / small_nodes - 1);
        nodes_ = make_scratch<BinaryNode>(used + static_cast<std::size_t>(threads + 2) * node_chunk);
    }

    BinaryTree run() {
        BuildRange whole;
        whole.count = count_;
        measure_all(whole);
        whole.capacity = capacity_;
        spatial_.least_overlap = least_overlap * half_area(whole.hi - whole.lo);
        next_chunk_ = 1;
        split_top({0, whole, 0});
        if (threads_ > 1) {
            parallel_for(threads_, static_cast<std::size_t>(threads_), [this](std::size_t) { work(); });
        } else {
            work();
        }
        return {std::move(nodes_), next_chunk_.load()};
    }

private:
    void measure_all(BuildRange& whole) const {
        constexpr std::uint32_t piece = 65536;
        std::vector<BuildRange> parts(piece_count(count_, piece));
        parallel_for(threads_, parts.size(), [&](std::size_t i) {
            parts[i].first = static_cast<std::uint32_t>(i) * piece;
            parts[i].count = std::min(piece, count_ - parts[i].first);
            measure(refs_, parts[i]);
        });
        whole = parts[0];
        whole.count = count_;
        for (const BuildRange& part : parts) {
            whole.lo = min4(whole.lo, part.lo), whole.hi = max4(whole.hi, part.hi);
            whole.centre_lo = min4(whole.centre_lo, part.centre_lo), whole.centre_hi = max4(whole.centre_hi, part.centre_hi);
            whole.kinds |= part.kinds;
        }
    }

    /// The first few splits, binned by all threads together, until there is work for each.
    void split_top(const Task& root) {
        std::vector<Task> open{root};
        while (open.size() < static_cast<std::size_t>(threads_)) {
            const auto largest = std::max_element(open.begin(), open.end(),
                                                  [](const Task& a, const Task& b) { return a.range.count < b.range.count; });
            if (largest->range.count < 2 * task_size) break;
            const Task task = *largest;
            BuildRange halves[2];
            split(task.range, task.depth, threads_, halves);
            const std::uint32_t children = make_inner(top_cursor_, task);
            *largest = {children, halves[0], task.depth + 1};
            open.push_back({children + 1, halves[1], task.depth + 1});
        }
        for (const Task& task : open) queue_.push(task);
    }

    void work() {
        NodeCursor cursor;
        Task task;
        try {
            for (bool working = false; queue_.pop(task, working);) build(cursor, task);
        } catch (...) { // out of memory
            queue_.abort();
            throw;
        }
    }

    void reserve(NodeCursor& cursor, std::uint32_t count) {
        if (cursor.end - cursor.next >= count) return;
        cursor.next = next_chunk_.fetch_add(node_chunk);
        cursor.end = cursor.next + node_chunk;
    }

    void set_node(std::uint32_t node, const BuildRange& range) {
        BinaryNode& out = nodes_[node];
        for (int axis = 0; axis < 3; ++axis) out.lo[axis] = range.lo[axis], out.hi[axis] = range.hi[axis];
        out.area = half_area(range.hi - range.lo);
        out.children = 0;
        out.first = range.first;
        out.count = range.count;
    }

    std::uint32_t make_inner(NodeCursor& cursor, const Task& task) {
        reserve(cursor, 2);
        set_node(task.node, task.range);
        const std::uint32_t children = cursor.next;
        cursor.next += 2;
        return nodes_[task.node].children = children;
    }

    /// Below every node, depth + ceil(log2(count)) <= max_bvh_depth: a split by area is allowed only below the limit and adds 1
    /// to the depth; at the limit, a split by count adds 1 to the depth and takes 1 from the logarithm. So an inner node, which
    /// has count >= 2, lies at depth max_bvh_depth - 1 or above.
    void split(const BuildRange& range, int depth, int threads, BuildRange halves[2]) {
        if (depth + static_cast<int>(std::bit_width(range.count - 1)) < max_bvh_depth)
            split_by_area(refs_, range, is_spatial_ ? &spatial_ : nullptr, threads, halves);
        else
            split_by_count(refs_, range, halves);
        share_room(range, halves);
    }

    /// Gives each half its share of the places that are left. Where a leaf may come to lie, references stay together.
    void share_room(const BuildRange& range, BuildRange halves[2]) {
        const std::uint32_t used = halves[0].count + halves[1].count;
        std::uint32_t room[2] = {};
        if (range.capacity > used && used > keep_together) {
            const std::uint32_t spare = range.capacity - used;
            room[0] = static_cast<std::uint32_t>(std::uint64_t{spare} * halves[0].count / used);
            room[1] = spare - room[0];
            std::memmove(refs_ + halves[1].first + room[0], refs_ + halves[1].first, halves[1].count * sizeof(BuildRef));
            halves[1].first += room[0];
        }
        for (int side = 0; side < 2; ++side) halves[side].capacity = halves[side].count + room[side];
    }

    void build(NodeCursor& cursor, const Task& task) {
        if (task.range.count <= max_leaf_size && !is_mixed(task.range)) {
            reserve(cursor, small_nodes);
            build_small(cursor, task.node, task.range, task.depth);
            return;
        }
        BuildRange halves[2];
        split(task.range, task.depth, 1, halves);
        const std::uint32_t children = make_inner(cursor, task);
        const Task right{children + 1, halves[1], task.depth + 1};
        const bool shared = threads_ > 1 && right.range.count >= task_size;
        if (shared) queue_.push(right);
        build(cursor, {children, halves[0], task.depth + 1});
        if (!shared) build(cursor, right);
    }

    /// Of one kind and at most max_leaf_size: decides bottom-up, returns the cost. The nodes of a subtree that loses are given
    /// back. With spatial splits every leaf has one primitive here: bvh_cut joins them.
    float build_small(NodeCursor& cursor, std::uint32_t node, const BuildRange& range, int depth) {
        set_node(node, range);
        const float area = nodes_[node].area;
        // Eight triangles take little longer than one; quadrics are met one by one (docs/bvh.md).
        const auto count = static_cast<float>(range.count);
        const bool together = kind_of(refs_[range.first]) == static_cast<std::uint32_t>(PrimitiveKind::triangle);
        const float leaf_cost = area * (together ? 0.75f + 0.25f * count : count);
        if (range.count == 1 || (!is_spatial_ && cannot_pay(range, area, leaf_cost))) return leaf_cost;
        const NodeCursor before = cursor;
        BuildRange halves[2];
        split(range, depth, 1, halves);
        // No subtree costs less than its area.
        if (!is_spatial_ && area + half_area(halves[0].hi - halves[0].lo) + half_area(halves[1].hi - halves[1].lo) >= leaf_cost)
            return leaf_cost;
        const std::uint32_t children = cursor.next;
        cursor.next += 2;
        float cost = area;
        for (std::uint32_t side = 0; side < 2; ++side) cost += build_small(cursor, children + side, halves[side], depth + 1);
        if (cost < leaf_cost || is_spatial_) {
            nodes_[node].children = children;
            return cost;
        }
        cursor = before;
        return leaf_cost;
    }

    /// Any two halves have together at least the area of the largest primitive and of the smallest.
    [[nodiscard]] bool cannot_pay(const BuildRange& range, float area, float leaf_cost) const {
        if (range.count > 4) return false;
        float smallest = area, largest = 0;
        for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
            const float own = half_area(hi_of(refs_[i]) - lo_of(refs_[i]));
            smallest = std::min(smallest, own);
            largest = std::max(largest, own);
        }
        return area + largest + smallest >= leaf_cost;
    }

    BuildRef* refs_;
    std::uint32_t count_, capacity_;
    SpatialSplits spatial_;
    bool is_spatial_ = false;
    int threads_;
    Scratch<BinaryNode> nodes_;
    std::atomic<std::uint32_t> next_chunk_{1};
    NodeCursor top_cursor_;
    TaskQueue queue_;
};

} // namespace

BinaryTree build_binary(BuildRef* refs, std::size_t count, const SpatialRoom* spatial, int threads) {
    return Builder(refs, count, spatial, std::max(threads, 1)).run();
}

} // namespace lanecast
