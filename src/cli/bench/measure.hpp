#pragma once
// Rates by the chunk: a context switch spoils one chunk of one repetition, and the median drops it.

#include "cli/bench/contender.hpp"

namespace lanecast::bench {

struct Rate {
    double rays_per_second = 0; ///< n / sum over chunks of the median over repetitions
    double low = 0, high = 0;   ///< of whole repetitions: quartiles
};

struct Measured {
    std::vector<Rate> rates;   ///< by contender
    std::vector<HitList> hits; ///< by contender
};

/// All contenders trace the whole set in turn, in every repetition; a first turn is not timed. With several threads each takes a
/// run of chunks, and their rates are added.
[[nodiscard]] Measured measure(const Contenders& contenders, const RaySet& set, int repetitions, int threads);

/// Of the time-stamp counter.
[[nodiscard]] double ticks_per_second();

} // namespace lanecast::bench
