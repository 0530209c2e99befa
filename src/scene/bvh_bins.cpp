#include "scene/bvh_bins.hpp"

#include "scene/parallel.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace lanecast {
namespace {

constexpr std::uint32_t parallel_piece = 32768; ///< primitives binned by one thread at a time

/// Box and count are one record. With an array each, g++ 12.2 at -O1 addressed the boxes by way of the pointer to the counts
/// (ivopts), took what was stored there for counts, and dropped the loop that emptied the boxes.
struct Bin {
    Float4 lo, hi;
    std::uint32_t count;
};

using Offsets [[gnu::vector_size(16)]] = std::uint32_t;

/// The first `used` of each axis are empty.
struct Bins {
    Bin bin[3][max_bins];
    explicit Bins(int used) {
        for (auto& of_axis : bin)
            for (int b = 0; b < used; ++b) of_axis[b] = {splat4(empty_lo), splat4(-empty_lo), 0};
    }
};

void grow(Bin& bin, Float4 lo, Float4 hi) {
    bin.lo = min4(bin.lo, lo);
    bin.hi = max4(bin.hi, hi);
}

/// Where the bins of the three axes lie is computed for all at once.
void add(Bins& bins, const BuildRef& ref, const BinMapping& mapping) {
    constexpr std::int32_t bytes = sizeof(Bin);
    const Float4 lo = lo_of(ref), hi = hi_of(ref);
    const Int4 offset = mapping(lo + hi) * bytes;
    const auto place = reinterpret_cast<Offsets>(offset);
    for (int axis = 0; axis < 3; ++axis) {
        Bin& own = *reinterpret_cast<Bin*>(reinterpret_cast<unsigned char*>(bins.bin[axis]) + place[axis]);
        grow(own, lo, hi);
        ++own.count;
    }
}

void merge(Bins& bins, const Bins& other, int used) {
    for (int axis = 0; axis < 3; ++axis)
        for (int b = 0; b < used; ++b) {
            const Bin& from = other.bin[axis][b];
            grow(bins.bin[axis][b], from.lo, from.hi);
            bins.bin[axis][b].count += from.count;
        }
}

/// Neighbours often fall into one bin, and would wait for each other's stores: every other one has bins of its own. Measured: up
/// to 10 % of flattening.
void count_into(Bins& bins, const BuildRef* refs, std::uint32_t count, const BinMapping& mapping) {
    constexpr std::uint32_t worth_merging = 512;
    std::uint32_t i = 0;
    if (count >= worth_merging) {
        Bins odd(mapping.bins);
        for (; i + 1 < count; i += 2) {
            add(bins, refs[i], mapping);
            add(odd, refs[i + 1], mapping);
        }
        merge(bins, odd, mapping.bins);
    }
    for (; i < count; ++i) add(bins, refs[i], mapping);
}

Int4 counts_of(const Bins& bins, int b) {
    return Int4{static_cast<std::int32_t>(bins.bin[0][b].count), static_cast<std::int32_t>(bins.bin[1][b].count),
                static_cast<std::int32_t>(bins.bin[2][b].count), 0};
}

/// Cheapest cut of all axes: area times count, summed over both halves. A lane per axis.
BinCut cheapest(const Bins& bins, std::uint32_t total, int used) {
    Float4 lo[4], hi[4], right_area[max_bins]; // the fourth box stays empty
    const auto grow_all = [&](int b) {
        for (int axis = 0; axis < 3; ++axis) {
            lo[axis] = min4(lo[axis], bins.bin[axis][b].lo);
            hi[axis] = max4(hi[axis], bins.bin[axis][b].hi);
        }
    };
    std::fill_n(lo, 4, splat4(empty_lo)), std::fill_n(hi, 4, splat4(-empty_lo));
    for (int b = used - 1; b > 0; --b) {
        grow_all(b);
        right_area[b] = half_areas(lo, hi);
    }
    std::fill_n(lo, 4, splat4(empty_lo)), std::fill_n(hi, 4, splat4(-empty_lo));
    const auto all = static_cast<std::int32_t>(total);
    Int4 left{}, best_bin{}, best_left{};
    Float4 best_cost = splat4(std::numeric_limits<float>::infinity());
    for (int b = 1; b < used; ++b) {
        grow_all(b - 1);
        left += counts_of(bins, b - 1);
        // Of a half without primitives the area is infinite, and the cost so no number, which is never less.
        const Float4 cost = half_areas(lo, hi) * __builtin_convertvector(left, Float4) +
                            right_area[b] * __builtin_convertvector(all - left, Float4);
        const Int4 better = cost < best_cost;
        best_cost = better ? cost : best_cost;
        best_bin = better ? Int4{} + b : best_bin;
        best_left = better ? left : best_left;
    }
    BinCut best;
    best.cost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (!(best_cost[axis] < best.cost)) continue;
        best.cost = best_cost[axis], best.axis = axis, best.bin = best_bin[axis];
        best.left_count = static_cast<std::uint32_t>(best_left[axis]);
    }
    if (best.axis < 0) return best;
    for (int side = 0; side < 2; ++side) {
        best.lo[side] = splat4(empty_lo), best.hi[side] = splat4(-empty_lo);
        for (int b = side == 0 ? 0 : best.bin; b < (side == 0 ? best.bin : used); ++b) {
            best.lo[side] = min4(best.lo[side], bins.bin[best.axis][b].lo);
            best.hi[side] = max4(best.hi[side], bins.bin[best.axis][b].hi);
        }
    }
    return best;
}

} // namespace

BinMapping make_bin_mapping(const BuildRange& range) {
    BinMapping mapping;
    mapping.bins = static_cast<int>(std::min<std::uint32_t>(max_bins, 4 + range.count / 8));
    mapping.origin = range.centre_lo;
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = range.centre_hi[axis] - range.centre_lo[axis];
        // A little less than the number of bins, so that the largest centre falls into the last one.
        mapping.scale[axis] = extent > 1e-30f ? static_cast<float>(mapping.bins) * 0.9999f / extent : 0.0f;
    }
    return mapping;
}

BinCut find_bin_cut(const BuildRef* refs, const BuildRange& range, const BinMapping& mapping, int threads) {
    Bins bins(mapping.bins);
    if (threads <= 1 || range.count < 2 * parallel_piece) {
        count_into(bins, refs + range.first, range.count, mapping);
    } else { // minima, maxima and sums of integers do not depend on the order
        std::vector<Bins> pieces(piece_count(range.count, parallel_piece), Bins(mapping.bins));
        parallel_for(threads, pieces.size(), [&](std::size_t i) {
            const auto begin = static_cast<std::uint32_t>(i) * parallel_piece;
            count_into(pieces[i], refs + range.first + begin, std::min(parallel_piece, range.count - begin), mapping);
        });
        for (const Bins& piece : pieces) merge(bins, piece, mapping.bins);
    }
    return cheapest(bins, range.count, mapping.bins);
}

} // namespace lanecast
