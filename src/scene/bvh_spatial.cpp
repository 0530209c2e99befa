#include "scene/bvh_spatial.hpp"

#include "scene/bvh_split.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace lanecast {
namespace {

constexpr int plane_bins = 16;

struct Box {
    Float4 lo = splat4(empty_lo), hi = splat4(-empty_lo);
};

void grow(Box& box, Float4 lo, Float4 hi) {
    box.lo = min4(box.lo, lo);
    box.hi = max4(box.hi, hi);
}
void grow(Box& box, const BuildRef& ref) { grow(box, lo_of(ref), hi_of(ref)); }

float area_of(const Box& box) { return half_area(box.hi - box.lo); }

bool is_triangle(const BuildRef& ref) { return kind_of(ref) == static_cast<std::uint32_t>(PrimitiveKind::triangle); }

/// Bins between planes at equal distances, on one axis.
struct Slabs {
    float origin = 0, scale = 0, width = 0;

    [[nodiscard]] int bin(float x) const { return std::clamp(static_cast<int>((x - origin) * scale), 0, plane_bins - 1); }
    [[nodiscard]] float plane(int bin) const { return origin + width * static_cast<float>(bin); } ///< below the bin
};

Slabs make_slabs(const BuildRange& range, int axis) {
    const float extent = range.hi[axis] - range.lo[axis];
    if (!(extent > 1e-30f)) return {};
    return {range.lo[axis], static_cast<float>(plane_bins) / extent, extent / static_cast<float>(plane_bins)};
}

struct SlabBins {
    Box box[plane_bins];
    std::uint32_t enter[plane_bins] = {}, leave[plane_bins] = {}; ///< references whose first, last bin it is
};

/// First and last bin. What cannot be chopped has one.
std::pair<int, int> bins_of(const BuildRef& ref, const Slabs& slabs, int axis) {
    if (is_triangle(ref)) return {slabs.bin(ref.lo[axis]), slabs.bin(ref.hi[axis])};
    const int bin = slabs.bin(0.5f * (ref.lo[axis] + ref.hi[axis]));
    return {bin, bin};
}

void count_into(SlabBins& bins, const BuildRef& ref, const Slabs& slabs, int axis, const SpatialSplits& splits) {
    const auto [first, last] = bins_of(ref, slabs, axis);
    ++bins.enter[first];
    ++bins.leave[last];
    if (first == last) return grow(bins.box[first], ref);
    const std::array<const float*, 3> corners = splits.corners_of(ref);
    BuildRef rest = ref;
    for (int b = first; b < last; ++b) {
        BuildRef parts[2];
        const unsigned used = chop(rest, corners, axis, slabs.plane(b + 1), parts);
        if ((used & 1u) != 0) grow(bins.box[b], parts[0]);
        if ((used & 2u) == 0) return;
        rest = parts[1];
    }
    grow(bins.box[last], rest);
}

struct PlaneCut {
    int axis = -1;
    int bin = 0; ///< first of the right half
    float cost = std::numeric_limits<float>::infinity();
    Slabs slabs;
    Box box[2];
    std::uint32_t count[2] = {};
};

void find_on_axis(const SlabBins& bins, const Slabs& slabs, int axis, std::uint32_t capacity, PlaneCut& best) {
    Box right_box[plane_bins];
    std::uint32_t right_count[plane_bins];
    Box box;
    std::uint32_t count = 0;
    for (int b = plane_bins - 1; b > 0; --b) {
        grow(box, bins.box[b].lo, bins.box[b].hi);
        count += bins.leave[b];
        right_box[b] = box, right_count[b] = count;
    }
    box = {};
    count = 0;
    for (int b = 1; b < plane_bins; ++b) {
        grow(box, bins.box[b - 1].lo, bins.box[b - 1].hi);
        count += bins.enter[b - 1];
        if (count == 0 || right_count[b] == 0 || count + right_count[b] > capacity) continue;
        const float cost = area_of(box) * static_cast<float>(count) + area_of(right_box[b]) * static_cast<float>(right_count[b]);
        if (cost < best.cost) best = {axis, b, cost, slabs, {box, right_box[b]}, {count, right_count[b]}};
    }
}

/// The halves of a plane cut. A straddling reference is left whole on one side where that is cheaper than to have it in both.
class Sorter {
public:
    explicit Sorter(const PlaneCut& cut) : cut_(cut), boxes_{cut.box[0], cut.box[1]}, counts_{cut.count[0], cut.count[1]} {}

    void add(const BuildRef& ref, const SpatialSplits& splits) {
        const auto [first, last] = bins_of(ref, cut_.slabs, cut_.axis);
        if (last < cut_.bin) return left.push_back(ref);
        if (first >= cut_.bin) return right.push_back(ref);
        Box wider[2] = {boxes_[0], boxes_[1]};
        for (Box& box : wider) grow(box, ref);
        const auto n0 = static_cast<float>(counts_[0]), n1 = static_cast<float>(counts_[1]);
        const float a0 = area_of(boxes_[0]), a1 = area_of(boxes_[1]);
        const float both = a0 * n0 + a1 * n1;
        const float only_left = area_of(wider[0]) * n0 + a1 * (n1 - 1);
        const float only_right = a0 * (n0 - 1) + area_of(wider[1]) * n1;
        BuildRef parts[2] = {ref, ref};
        unsigned used = 3;
        if (std::min(only_left, only_right) < both)
            used = only_left <= only_right ? 1 : 2;
        else
            used = chop(ref, splits.corners_of(ref), cut_.axis, cut_.slabs.plane(cut_.bin), parts);
        if (used != 3) {
            const std::size_t side = used == 1 ? 0 : 1;
            parts[side] = ref;
            boxes_[side] = wider[side];
            --counts_[1 - side];
        }
        if ((used & 1u) != 0) left.push_back(parts[0]);
        if ((used & 2u) != 0) right.push_back(parts[1]);
    }

    std::vector<BuildRef> left, right;

private:
    const PlaneCut& cut_;
    Box boxes_[2];
    std::uint32_t counts_[2];
};

} // namespace

unsigned chop(const BuildRef& ref, const std::array<const float*, 3>& corners, int axis, float x, BuildRef parts[2]) {
    const Float4 vertices[3] = {load_xyz(corners[0]), load_xyz(corners[1]), load_xyz(corners[2])};
    Box whole, side[2];
    for (const Float4 v : vertices) grow(whole, v, v);
    for (std::size_t i = 0, j = 1; i < 3; ++i, j = j == 2 ? 0 : j + 1) {
        const float a = corners[i][axis], b = corners[j][axis];
        if (a <= x) grow(side[0], vertices[i], vertices[i]);
        if (a >= x) grow(side[1], vertices[i], vertices[i]);
        if ((a < x && b > x) || (a > x && b < x)) {
            const Float4 crossing = vertices[i] + (vertices[j] - vertices[i]) * splat4((x - a) / (b - a));
            for (Box& box : side) grow(box, crossing, crossing);
        }
    }
    // The second term covers the rounding above.
    const Float4 extent = whole.hi - whole.lo, magnitude = max4(whole.hi, -whole.lo);
    const Float4 pad = splat4(std::max({extent[0], extent[1], extent[2]}) * 0x1p-14f +
                              std::max({magnitude[0], magnitude[1], magnitude[2]}) * 0x1p-21f);
    const Float4 ref_lo = lo_of(ref), ref_hi = hi_of(ref);
    unsigned used = 0;
    for (unsigned i = 0; i < 2; ++i) {
        const Float4 lo = max4(side[i].lo - pad, ref_lo), hi = min4(side[i].hi + pad, ref_hi);
        parts[i] = ref;
        std::memcpy(parts[i].lo, &lo, sizeof parts[i].lo);
        std::memcpy(parts[i].hi, &hi, sizeof parts[i].hi);
        const Int4 empty = lo > hi; // the fourth lanes are made of 0
        if ((empty[0] | empty[1] | empty[2]) == 0) used |= 1u << i;
    }
    return used;
}

bool split_by_plane(BuildRef* refs, const BuildRange& range, const BinCut& cut, const SpatialSplits& splits,
                    BuildRange halves[2]) {
    if (range.capacity <= range.count) return false;
    const Float4 shared = min4(cut.hi[0], cut.hi[1]) - max4(cut.lo[0], cut.lo[1]);
    if (shared[0] < 0 || shared[1] < 0 || shared[2] < 0 || half_area(shared) <= splits.least_overlap) return false;
    BuildRef* const own = refs + range.first;
    PlaneCut best;
    best.cost = cut.cost;
    for (int axis = 0; axis < 3; ++axis) {
        const Slabs slabs = make_slabs(range, axis);
        if (slabs.scale == 0) continue;
        SlabBins bins;
        for (std::uint32_t i = 0; i < range.count; ++i) count_into(bins, own[i], slabs, axis, splits);
        find_on_axis(bins, slabs, axis, range.capacity, best);
    }
    if (best.axis < 0) return false;

    Sorter sorter(best);
    for (std::uint32_t i = 0; i < range.count; ++i) sorter.add(own[i], splits);
    const std::size_t left = sorter.left.size(), right = sorter.right.size();
    if (std::min(left, right) == 0 || std::max(left, right) >= range.count || left + right > range.capacity) return false;
    std::copy(sorter.left.begin(), sorter.left.end(), own);
    std::copy(sorter.right.begin(), sorter.right.end(), own + left);
    halves[0].first = range.first;
    halves[0].count = static_cast<std::uint32_t>(left);
    halves[1].first = range.first + halves[0].count;
    halves[1].count = static_cast<std::uint32_t>(right);
    measure(refs, halves[0]);
    measure(refs, halves[1]);
    return true;
}

} // namespace lanecast
