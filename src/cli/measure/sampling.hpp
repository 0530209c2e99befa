#pragma once
// How much of a frame trials can afford to look at, and where.

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

/// As many tiles, but half of them where errors are to be expected: a mirror as small as a tile is all that a depth changes, and
/// lies between tiles that are spread evenly. `looks_seconds`: processor time that pictures of all of the frame may take, which
/// tell where: without anti-aliasing, each with one knob turned down. Where they cannot be had of many more tiles than the sample
/// has, it is spread evenly. `badness`: what adds up of an error of RMSE r.
[[nodiscard]] TileSample telling_sample(const Bench& bench, const Choice& truth, const std::vector<Ladder>& ladders,
                                        const SampleLimits& limits, double looks_seconds,
                                        const std::function<double(double r)>& badness);

} // namespace lanecast::trade
