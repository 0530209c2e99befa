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

void partition_at_cut(BuildRef* refs, const BuildRange& range, const BinMapping& mapping, const BinCut& cut,
                      BuildRange halves[2]) {
    Float4 lo[2] = {splat4(empty_lo), splat4(empty_lo)}, hi[2] = {splat4(-empty_lo), splat4(-empty_lo)};
    const Int4 axis_lane = Int4{0, 1, 2, 3} == cut.axis;
    partition(refs + range.first, range.count, [&](const BuildRef& ref) {
        const Float4 centre = lo_of(ref) + hi_of(ref);
        const Int4 bin = mapping(centre) & axis_lane; // the other lanes are 0
        const bool is_left = (bin[0] | bin[1] | bin[2]) < cut.bin;
        const Int4 left_mask = Int4{} - static_cast<int>(is_left);
        lo[0] = min4(lo[0], left_mask ? centre : splat4(empty_lo));
        hi[0] = max4(hi[0], left_mask ? centre : splat4(-empty_lo));
        lo[1] = min4(lo[1], left_mask ? splat4(empty_lo) : centre);
        hi[1] = max4(hi[1], left_mask ? splat4(-empty_lo) : centre);
        return is_left;
    });
    set_counts(range, cut.left_count, halves);
    for (int side = 0; side < 2; ++side) {
        halves[side].lo = cut.lo[side], halves[side].hi = cut.hi[side];
        halves[side].centre_lo = lo[side], halves[side].centre_hi = hi[side];
        set_kinds(refs, range, halves[side]);
    }
}

/// Order of keys, equal ones as they lie. Counts for each pair who comes first, so nothing branches on the keys.
void sort_small(const float* keys, std::uint32_t count, std::uint8_t* order) {
    std::uint32_t rank[sweep_limit] = {};
    for (std::uint32_t i = 1; i < count; ++i)
        for (std::uint32_t j = 0; j < i; ++j) {
            const std::uint32_t later_first = keys[i] < keys[j] ? 1u : 0u;
            rank[j] += later_first;
            rank[i] += 1u - later_first;
        }
    for (std::uint32_t i = 0; i < count; ++i) order[rank[i]] = static_cast<std::uint8_t>(i);
}

/// What `count` primitives will cost per area, in quarters: 3 for a leaf, 1 for each of them. Kinds never share a leaf.
float expected_cost(std::uint32_t count, bool mixed, std::uint32_t kinds) {
    return static_cast<float>(count + 3 * (mixed ? static_cast<std::uint32_t>(std::popcount(kinds)) : 1));
}

/// All cuts along all axes, and between kinds where they are mixed.
void split_exactly(BuildRef* refs, const BuildRange& range, BuildRange halves[2]) {
    const std::uint32_t count = range.count;
    BuildRef* const own = refs + range.first;
    Float4 lo[sweep_limit], hi[sweep_limit];
    float keys[4][sweep_limit];
    for (std::uint32_t i = 0; i < count; ++i) {
        lo[i] = lo_of(own[i]), hi[i] = hi_of(own[i]);
        const Float4 centre = lo[i] + hi[i];
        for (int axis = 0; axis < 3; ++axis) keys[axis][i] = centre[axis];
        keys[3][i] = static_cast<float>(kind_of(own[i]));
    }
    const bool mixed = is_mixed(range);
    const int ways = mixed ? 4 : 3;
    std::uint8_t order[4][sweep_limit];
    float best_cost = std::numeric_limits<float>::infinity();
    int best_way = 0;
    std::uint32_t best_left = count / 2; // should no cost be a number
    for (int way = 0; way < ways; ++way) {
        sort_small(keys[way], count, order[way]);
        float right_cost[sweep_limit];
        std::uint32_t kinds = 0;
        Float4 box_lo = splat4(empty_lo), box_hi = splat4(-empty_lo);
        for (std::uint32_t i = count - 1; i > 0; --i) {
            box_lo = min4(box_lo, lo[order[way][i]]);
            box_hi = max4(box_hi, hi[order[way][i]]);
            if (mixed) kinds |= 1u << kind_of(own[order[way][i]]);
            right_cost[i] = half_area(box_hi - box_lo) * expected_cost(count - i, mixed, kinds);
        }
        box_lo = splat4(empty_lo), box_hi = splat4(-empty_lo);
        kinds = 0;
        for (std::uint32_t i = 1; i < count; ++i) {
            box_lo = min4(box_lo, lo[order[way][i - 1]]);
            box_hi = max4(box_hi, hi[order[way][i - 1]]);
            if (mixed) kinds |= 1u << kind_of(own[order[way][i - 1]]);
            const float cost = half_area(box_hi - box_lo) * expected_cost(i, mixed, kinds) + right_cost[i];
            if (cost < best_cost) best_cost = cost, best_way = way, best_left = i;
        }
    }
    BuildRef sorted[sweep_limit];
    for (std::uint32_t i = 0; i < count; ++i) sorted[i] = own[order[best_way][i]];
    std::copy_n(sorted, count, own);
    set_counts(range, best_left, halves);
    for (int side = 0; side < 2; ++side) {
        Float4 box_lo = splat4(empty_lo), box_hi = splat4(-empty_lo);
        const std::uint32_t begin = side == 0 ? 0 : best_left, end = side == 0 ? best_left : count;
        for (std::uint32_t i = begin; i < end; ++i) {
            box_lo = min4(box_lo, lo[order[best_way][i]]);
            box_hi = max4(box_hi, hi[order[best_way][i]]);
        }
        halves[side].lo = box_lo, halves[side].hi = box_hi; // the boxes of centres are not needed below this size
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
