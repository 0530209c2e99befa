// The dither mask is a table in the source; this is how it was made.
#include "render/dither_mask.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace lanecast;

namespace {

constexpr int size = dither_size, cells = size * size;

/// A set of points on a torus, and at every cell the sum of a Gaussian of its distances to them (sigma 1.5, in units of 2^-20, so
/// that sums are exact in any order).
struct Pattern {
    std::array<std::int64_t, cells> weight{}; ///< by distance from cell 0
    std::array<std::int64_t, cells> energy{};
    std::array<bool, cells> set{};

    Pattern() {
        for (int i = 0; i < cells; ++i) {
            const int dx = std::min(i % size, size - i % size), dy = std::min(i / size, size - i / size);
            weight[static_cast<std::size_t>(i)] = std::llround(1048576.0 * std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5)));
        }
    }
    void flip(int cell) {
        auto& is_set = set[static_cast<std::size_t>(cell)];
        is_set = !is_set;
        for (int i = 0; i < cells; ++i) {
            const int dx = (i % size - cell % size + size) % size, dy = (i / size - cell / size + size) % size;
            energy[static_cast<std::size_t>(i)] += (is_set ? 1 : -1) * weight[static_cast<std::size_t>(dx + dy * size)];
        }
    }
    /// The set cell with the most energy (sign 1) or the free one with the least (sign -1); the first of equals.
    [[nodiscard]] int extreme(bool among_set) const {
        int best = -1;
        for (int i = 0; i < cells; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (set[at] != among_set) continue;
            if (best < 0 || (among_set ? energy[at] > energy[static_cast<std::size_t>(best)]
                                       : energy[at] < energy[static_cast<std::size_t>(best)]))
                best = i;
        }
        return best;
    }
    [[nodiscard]] int tightest_cluster() const { return extreme(true); }
    [[nodiscard]] int largest_void() const { return extreme(false); }
};

/// Ulichney, "The void-and-cluster method for dither array generation" (1993). Ranks 0 to cells - 1.
std::array<int, cells> void_and_cluster() {
    Pattern pattern;
    const int ones = cells / 10;
    std::uint32_t random = 1;
    for (int n = 0; n < ones;) { // Numerical Recipes' generator, high bits
        random = random * 1664525u + 1013904223u;
        const int cell = static_cast<int>(random >> 16) % cells;
        if (pattern.set[static_cast<std::size_t>(cell)]) continue;
        pattern.flip(cell);
        ++n;
    }
    for (;;) { // until moving the tightest cluster into the largest void changes nothing
        const int from = pattern.tightest_cluster();
        pattern.flip(from);
        const int to = pattern.largest_void();
        pattern.flip(to);
        if (from == to) break;
    }
    std::array<int, cells> rank{};
    Pattern shrinking = pattern;
    for (int n = ones - 1; n >= 0; --n) {
        const int cell = shrinking.tightest_cluster();
        shrinking.flip(cell);
        rank[static_cast<std::size_t>(cell)] = n;
    }
    for (int n = ones; n < cells; ++n) {
        const int cell = pattern.largest_void();
        pattern.flip(cell);
        rank[static_cast<std::size_t>(cell)] = n;
    }
    return rank;
}

} // namespace

TEST_CASE("the dither mask is void-and-cluster noise, each level equally often") {
    const auto rank = void_and_cluster();
    int differences = 0;
    for (int i = 0; i < cells; ++i) {
        const int level = rank[static_cast<std::size_t>(i)] * dither_levels / cells;
        if (dither_mask[i / size][i % size] != level) ++differences;
    }
    CHECK(differences == 0);

    std::array<int, dither_levels> uses{};
    for (const auto& row : dither_mask)
        for (const auto level : row) {
            REQUIRE(level < dither_levels);
            ++uses[level];
        }
    for (const int n : uses) CHECK(n == cells / dither_levels);
}
