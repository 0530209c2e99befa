#include "scene/bvh_split.hpp"

#include "scene/bvh_bins.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace lanecast {
namespace {

constexpr std::uint32_t sweep_limit = 16; ///< ranges up to this size are cut exactly

void set_kinds(const BuildRef* refs, const BuildRange& parent, BuildRange& range) {
    range.kinds = parent.kinds;
    if (!is_mixed(parent)) return;
    range.kinds = 0;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) range.kinds |= 1u << kind_of(refs[i]);
}

void set_counts(const BuildRange& parent, std::uint32_t left_count, BuildRange halves[2]) {
    halves[0].first = parent.first;
    halves[0].count = left_count;
    halves[1].first = parent.first + left_count;
    halves[1].count = parent.count - left_count;
}

/// Moves the primitives with in_left(ref) to the front, without a branch that depends on it (Lomuto's scheme).
template <class InLeft>
std::uint32_t partition(BuildRef* refs, std::uint32_t count, InLeft&& in_left) {
    std::uint32_t left = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const BuildRef ref = refs[i];
        refs[i] = refs[left];
        refs[left] = ref;
        left += in_left(ref) ? 1u : 0u;
    }
    return left;
}

/// On one axis the bin is below cut.bin where the scaled centre is: the same operations as BinMapping's, so the same answer.
void partition_at_cut(BuildRef* refs, const BuildRange& range, const BinMapping& mapping, const BinCut& cut,
                      BuildRange halves[2]) {
    Float4 lo[2] = {splat4(empty_lo), splat4(empty_lo)}, hi[2] = {splat4(-empty_lo), splat4(-empty_lo)};
    const int axis = cut.axis;
    const float origin = mapping.origin[axis], scale = mapping.scale[axis], limit = static_cast<float>(cut.bin);
    // Added to a centre: nothing, or so much that it is outside every box. Measured: less work than selecting by a mask.
    const Float4 away[2] = {splat4(0), splat4(2 * empty_lo)};
    partition(refs + range.first, range.count, [&](const BuildRef& ref) {
        const bool is_left = (ref.lo[axis] + ref.hi[axis] - origin) * scale < limit;
        const Float4 centre = lo_of(ref) + hi_of(ref);
        const Float4 from_left = away[is_left ? 0 : 1], from_right = away[is_left ? 1 : 0];
        lo[0] = min4(lo[0], centre + from_left);
        hi[0] = max4(hi[0], centre - from_left);
        lo[1] = min4(lo[1], centre + from_right);
        hi[1] = max4(hi[1], centre - from_right);
        return is_left;
    });
    set_counts(range, cut.left_count, halves);
    for (int side = 0; side < 2; ++side) {
        halves[side].lo = cut.lo[side], halves[side].hi = cut.hi[side];
        halves[side].centre_lo = lo[side], halves[side].centre_hi = hi[side];
        set_kinds(refs, range, halves[side]);
    }
}

constexpr int largest_ways = 4; ///< by centre along three axes, by kind: a lane for each

/// Order of keys in each lane, equal ones as they lie. Counts for each pair who comes first, so nothing branches on the keys.
void sort_small(const Float4* keys, std::uint32_t count, std::uint8_t order[largest_ways][sweep_limit]) {
    Int4 rank[sweep_limit];
    for (std::uint32_t i = 0; i < count; ++i) {
        Int4 own{};
        for (std::uint32_t j = 0; j < i; ++j) {
            const Int4 later_first = keys[i] < keys[j]; // -1 or 0
            rank[j] -= later_first;
            own += later_first + 1;
        }
        rank[i] = own;
    }
    for (std::uint32_t i = 0; i < count; ++i)
        for (int way = 0; way < largest_ways; ++way) order[way][rank[i][way]] = static_cast<std::uint8_t>(i);
}

/// The primitives of a small range, sorted each way.
struct Sorted {
    std::uint32_t count = 0;
    int ways = 3;
    Float4 lo[sweep_limit], hi[sweep_limit];
    std::uint32_t kind[sweep_limit]; ///< as bits; set where kinds are mixed
    std::uint8_t order[largest_ways][sweep_limit];
};

/// Boxes that grow each way, with what their primitives will cost per area, in quarters: 3 for a leaf, 1 for each of them. Kinds
/// never share a leaf.
struct Growing {
    Float4 lo[largest_ways], hi[largest_ways];
    std::uint32_t kinds[largest_ways] = {};
    std::uint32_t count = 0;

    Growing() { std::fill_n(lo, largest_ways, splat4(empty_lo)), std::fill_n(hi, largest_ways, splat4(-empty_lo)); }

    void add(const Sorted& sorted, std::uint32_t place) {
        ++count;
        for (int way = 0; way < sorted.ways; ++way) {
            const std::uint8_t own = sorted.order[way][place];
            lo[way] = min4(lo[way], sorted.lo[own]);
            hi[way] = max4(hi[way], sorted.hi[own]);
            if (sorted.ways == largest_ways) kinds[way] |= sorted.kind[own];
        }
    }

    [[nodiscard]] Float4 costs(int ways) const {
        Int4 quarters = Int4{} + static_cast<std::int32_t>(count + 3);
        if (ways == largest_ways)
            for (int way = 0; way < ways; ++way) quarters[way] += 3 * (std::popcount(kinds[way]) - 1);
        return half_areas(lo, hi) * __builtin_convertvector(quarters, Float4);
    }
};

/// All cuts along all axes, and between kinds where they are mixed.
void split_exactly(BuildRef* refs, const BuildRange& range, BuildRange halves[2]) {
    BuildRef* const own = refs + range.first;
    Sorted sorted;
    sorted.count = range.count;
    const bool mixed = is_mixed(range);
    if (mixed) sorted.ways = largest_ways;
    Float4 keys[sweep_limit];
    for (std::uint32_t i = 0; i < range.count; ++i) {
        sorted.lo[i] = lo_of(own[i]), sorted.hi[i] = hi_of(own[i]);
        keys[i] = sorted.lo[i] + sorted.hi[i];
        if (!mixed) continue;
        keys[i][3] = static_cast<float>(kind_of(own[i]));
        sorted.kind[i] = 1u << kind_of(own[i]);
    }
    sort_small(keys, range.count, sorted.order);

    Float4 right_costs[sweep_limit];
    Growing right;
    for (std::uint32_t i = range.count - 1; i > 0; --i) {
        right.add(sorted, i);
        right_costs[i] = right.costs(sorted.ways);
    }
    Growing left;
    Float4 best_costs = splat4(std::numeric_limits<float>::infinity());
    Int4 best_lefts{};
    for (std::uint32_t i = 1; i < range.count; ++i) {
        left.add(sorted, i - 1);
        const Float4 costs = left.costs(sorted.ways) + right_costs[i];
        best_lefts = costs < best_costs ? Int4{} + static_cast<std::int32_t>(i) : best_lefts;
        best_costs = min4(costs, best_costs);
    }
    int best_way = 0;
    std::uint32_t best_left = range.count / 2; // should no cost be a number
    float best_cost = std::numeric_limits<float>::infinity();
    for (int way = 0; way < sorted.ways; ++way)
        if (best_costs[way] < best_cost) {
            best_cost = best_costs[way], best_way = way;
            best_left = static_cast<std::uint32_t>(best_lefts[way]);
        }

    const std::uint8_t* const order = sorted.order[best_way];
    BuildRef in_order[sweep_limit];
    for (std::uint32_t i = 0; i < range.count; ++i) in_order[i] = own[order[i]];
    std::copy_n(in_order, range.count, own);
    set_counts(range, best_left, halves);
    for (int side = 0; side < 2; ++side) {
        Float4 lo = splat4(empty_lo), hi = splat4(-empty_lo);
        const std::uint32_t begin = side == 0 ? 0 : best_left, end = side == 0 ? best_left : range.count;
        for (std::uint32_t i = begin; i < end; ++i) {
            lo = min4(lo, sorted.lo[order[i]]);
            hi = max4(hi, sorted.hi[order[i]]);
        }
        halves[side].lo = lo, halves[side].hi = hi; // the boxes of centres are not needed below this size
        set_kinds(refs, range, halves[side]);
    }
}

} // namespace

void measure(const BuildRef* refs, BuildRange& range) {
    range.lo = range.centre_lo = splat4(empty_lo);
    range.hi = range.centre_hi = splat4(-empty_lo);
    range.kinds = 0;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        const Float4 lo = lo_of(refs[i]), hi = hi_of(refs[i]);
        range.lo = min4(range.lo, lo);
        range.hi = max4(range.hi, hi);
        range.centre_lo = min4(range.centre_lo, lo + hi);
        range.centre_hi = max4(range.centre_hi, lo + hi);
        range.kinds |= 1u << kind_of(refs[i]);
    }
}

void split_by_area(BuildRef* refs, const BuildRange& range, const SpatialSplits* spatial, int threads, BuildRange halves[2]) {
    if (range.count <= sweep_limit) return split_exactly(refs, range, halves);
    const BinMapping mapping = make_bin_mapping(range);
    const BinCut cut = find_bin_cut(refs, range, mapping, threads);
    if (cut.axis >= 0 && spatial != nullptr && split_by_plane(refs, range, cut, *spatial, halves)) return;
    if (cut.axis >= 0) return partition_at_cut(refs, range, mapping, cut, halves);

    std::uint32_t left_count = range.count / 2;
    if (is_mixed(range)) {
        const auto first_kind = static_cast<std::uint32_t>(std::countr_zero(range.kinds));
        left_count = partition(refs + range.first, range.count, [&](const BuildRef& ref) { return kind_of(ref) == first_kind; });
    }
    set_counts(range, left_count, halves);
    measure(refs, halves[0]);
    measure(refs, halves[1]);
}

void split_by_count(BuildRef* refs, const BuildRange& range, BuildRange halves[2]) {
    BuildRange whole = range; // ranges that came from an exact cut do not know their centres
    measure(refs, whole);
    const Float4 extent = whole.centre_hi - whole.centre_lo;
    const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
    BuildRef* const own = refs + range.first;
    std::nth_element(own, own + range.count / 2, own + range.count,
                     [axis](const BuildRef& a, const BuildRef& b) { return a.lo[axis] + a.hi[axis] < b.lo[axis] + b.hi[axis]; });
    set_counts(range, range.count / 2, halves);
    measure(refs, halves[0]);
    measure(refs, halves[1]);
}

} // namespace lanecast
