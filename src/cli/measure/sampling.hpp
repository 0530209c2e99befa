#pragma once
// How much of a frame trials can afford to look at, and where.

#include "cli/measure/trial.hpp"

#include <cstddef>
#include <vector>

namespace lanecast::trade {

struct SampleLimits {
    double seconds = 0; ///< processor time per thread that the pictures together may take
    std::size_t least_tiles = 0, most_tiles = 0;
};

inline constexpr std::size_t tiles_surely_looked_at = 1 << 15; ///< a frame of 3840x2160 in tiles of 16x16

/// All tiles of the frame and of them as many pixels as can be afforded, at least every 16th. Of frames of more tiles than are
/// surely looked at: of as many, spread evenly, as can be afforded. At most 2^24 pixels.
[[nodiscard]] TileSample sample_to_look_at(const FrameOptions& options, double pixels);

/// As many tiles as can be afforded of all these pictures, half of them where errors are to be expected: a mirror as small as a
/// tile may be all that a depth changes, and lies between tiles that are spread evenly. Small tiles, because neighbours err
/// alike: many places tell more than many pixels. 16x16 pixels, and where there would be too few of those 8x8, at least a quarter
/// of the least number; 4x4 where those that were to be drawn are more than twice as dear as granted. What is expected is told by
/// pictures of `sample_to_look_at` without anti-aliasing, with one knob turned down from `truth` in each, in a fifth of the time.
/// `bench`: all but its sample. `badness`: what adds up of an error of this RMSE.
[[nodiscard]] TileSample affordable_sample(const Bench& bench, const std::vector<Choice>& pictures, const Choice& truth,
                                           const std::vector<Ladder>& ladders, const SampleLimits& limits,
                                           const std::function<double(double rmse)>& badness);

} // namespace lanecast::trade
