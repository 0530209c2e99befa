#pragma once
// Whether contenders found the same hits, and if not, why.

#include "cli/bench/contender.hpp"

#include <cstddef>
#include <vector>

namespace lanecast::bench {

/// Rays for which two disagree: one misses what the other hits, or t differs by more than 1e-3 of itself.
struct Disagreements {
    std::size_t checked = 0;
    std::size_t missed = 0, extra = 0, other_t = 0; ///< seen from the first of the two
    std::size_t ties = 0;                           ///< the same t, another triangle: no disagreement
    std::size_t edges = 0;                          ///< of them: the truth itself changes so when the ray moves by its rounding
    std::size_t upheld = 0;                         ///< of the others: the truth is the first one's
    [[nodiscard]] std::size_t count() const { return missed + extra + other_t; }
};

/// A set's rays that are checked, and what the double-precision reference finds for them.
struct Truth {
    const RaySet* set = nullptr;
    const Scene* reference = nullptr;
    double rounding = 0; ///< of a coordinate, in world units
    std::vector<std::size_t> rays;
    HitList hits; ///< by the order of `rays`
};

/// At most `count` rays, evenly spread.
[[nodiscard]] Truth find_truth(const RaySet& set, const Scene& reference, const BenchMesh& mesh, std::size_t count);

/// hits: of the whole set.
[[nodiscard]] Disagreements compare_to_truth(const HitList& hits, const Truth& truth);
[[nodiscard]] Disagreements compare_to_peer(const HitList& hits, const HitList& peer, const Truth& truth);

} // namespace lanecast::bench
