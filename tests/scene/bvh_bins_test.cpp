// Binned cuts of random ranges, with the code under test compiled at -O1, where g++ 12.2 once dropped the emptying of the bins.

#include "scene/bvh_bins.hpp"

#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

struct Range {
    std::vector<BuildRef> refs;
    BuildRange range;
};

Range random_range(std::mt19937& engine, std::uint32_t count) {
    std::uniform_real_distribution<float> place(-1, 1), size(0, 0.1f);
    Range out;
    out.refs.resize(count);
    out.range.count = count;
    out.range.lo = out.range.centre_lo = splat4(empty_lo);
    out.range.hi = out.range.centre_hi = splat4(-empty_lo);
    for (BuildRef& ref : out.refs) {
        for (int axis = 0; axis < 3; ++axis) {
            ref.lo[axis] = place(engine);
            ref.hi[axis] = ref.lo[axis] + size(engine);
        }
        const Float4 lo = lo_of(ref), hi = hi_of(ref);
        out.range.lo = min4(out.range.lo, lo), out.range.hi = max4(out.range.hi, hi);
        out.range.centre_lo = min4(out.range.centre_lo, lo + hi), out.range.centre_hi = max4(out.range.centre_hi, lo + hi);
    }
    return out;
}

/// What lies on the stack where the next call's bins will be: old numbers, all of them large.
[[gnu::noinline]] void dirty_the_stack() {
    volatile float old[4096];
    for (volatile float& x : old) x = 1e20f;
    static_cast<void>(old[0]);
}

bool same(Float4 a, Float4 b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

} // namespace

TEST_CASE("a cut's counts and boxes are those of the primitives on its sides, by one thread or two") {
    std::mt19937 engine(1);
    for (int i = 0; i < 2000; ++i) {
        const std::uint32_t count =
            i % 500 == 0 ? 70000 : 20 + static_cast<std::uint32_t>(engine() % 400); // the large ones are binned in pieces
        const Range random = random_range(engine, count);
        const BinMapping mapping = make_bin_mapping(random.range);
        for (const int threads : {1, 2}) {
            dirty_the_stack();
            const BinCut cut = find_bin_cut(random.refs.data(), random.range, mapping, threads);
            REQUIRE(cut.axis >= 0);
            std::uint32_t left = 0;
            Float4 lo[2] = {splat4(empty_lo), splat4(empty_lo)}, hi[2] = {splat4(-empty_lo), splat4(-empty_lo)};
            for (const BuildRef& ref : random.refs) {
                const int side = mapping(lo_of(ref) + hi_of(ref))[cut.axis] < cut.bin ? 0 : 1;
                left += side == 0 ? 1 : 0;
                lo[side] = min4(lo[side], lo_of(ref)), hi[side] = max4(hi[side], hi_of(ref));
            }
            REQUIRE(cut.left_count == left);
            for (int side = 0; side < 2; ++side) {
                REQUIRE(same(cut.lo[side], lo[side]));
                REQUIRE(same(cut.hi[side], hi[side]));
            }
        }
    }
}
