#pragma once
// How much of a frame trials can afford to look at.

#include "cli/measure/trial.hpp"

#include <cstddef>
#include <vector>

namespace lanecast::trade {

struct SampleLimits {
    double seconds = 0; ///< processor time that the pictures together may take
    std::size_t least_tiles = 0, most_tiles = 0;
};

/// Tiles spread over the frame, as many as can be afforded of all these pictures. Small ones, because neighbours err alike: many
/// places tell more than many pixels. 16x16 pixels, and where there would be too few of those 8x8, at least a quarter of the
/// least number. `bench`: all but its sample.
[[nodiscard]] TileSample affordable_sample(const Bench& bench, const std::vector<Choice>& pictures, const SampleLimits& limits);

} // namespace lanecast::trade
