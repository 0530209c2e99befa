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

void count_into(Bins& bins, const BuildRef* refs, std::uint32_t count, const BinMapping& mapping) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const Float4 lo = lo_of(refs[i]), hi = hi_of(refs[i]);
        const Int4 index = mapping(lo + hi);
        for (int axis = 0; axis < 3; ++axis) {
            Bin& own = bins.bin[axis][index[axis]];
            grow(own, lo, hi);
            ++own.count;
        }
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

/// Cheapest cut of all axes: area times count, summed over both halves.
BinCut cheapest(const Bins& bins, std::uint32_t total, int used) {
    BinCut best;
    float best_cost = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        float right_area[max_bins];
        Float4 lo = splat4(empty_lo), hi = splat4(-empty_lo);
        for (int b = used - 1; b > 0; --b) {
            lo = min4(lo, bins.bin[axis][b].lo);
            hi = max4(hi, bins.bin[axis][b].hi);
            right_area[b] = half_area(hi - lo);
        }
        lo = splat4(empty_lo), hi = splat4(-empty_lo);
        std::uint32_t left = 0;
        for (int b = 1; b < used; ++b) {
            lo = min4(lo, bins.bin[axis][b - 1].lo);
            hi = max4(hi, bins.bin[axis][b - 1].hi);
            left += bins.bin[axis][b - 1].count;
            if (left == 0) continue;
            if (left == total) break;
            const float cost = half_area(hi - lo) * static_cast<float>(left) + right_area[b] * static_cast<float>(total - left);
            if (cost < best_cost) best_cost = cost, best.axis = axis, best.bin = b, best.left_count = left;
        }
    }
    if (best.axis < 0) return best;
    best.cost = best_cost;
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
