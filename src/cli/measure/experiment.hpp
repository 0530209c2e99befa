#pragma once
// The whole measurement of a scene, and what came of it.

#include "cli/measure/ray_errors.hpp"
#include "cli/measure/walk.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lanecast::trade {

/// A choice, tried. Times are processor time of a whole frame, in seconds.
struct Trial {
    Choice choice;
    PictureError error;                    ///< against the reference
    double seconds = 0, low = 0, high = 0; ///< median and range of the repetitions
    double file_seconds = 0;               ///< to encode the file
    double rays = 0;                       ///< of a frame
    [[nodiscard]] double total() const { return seconds + file_seconds; }
};

/// The scene's settings with one knob turned.
struct KnobRow {
    Knob knob = Knob::precision;
    std::string value;
    bool given = false; ///< the scene's own value
    std::size_t trial = 0;
    PictureError own; ///< of the knob alone: against the same settings with this knob at its truth, by the reference
};

struct Report {
    std::string scene, cpu, compiler;
    int width = 0, height = 0, threads = 1, repetitions = 0;
    std::size_t tiles = 0;
    int tile_size = 0;
    bool whole = true; ///< every tile; else times are scaled to the frame
    double share = 1;  ///< of the frame's pixels that were rendered
    std::vector<Ladder> ladders;
    Choice base, truth;
    double truth_seconds = 0;
    /// How far another picture with fewer samples, balanced, is from the reference: what is below is not resolved.
    std::string second_choice;
    PictureError second;
    std::vector<Trial> trials; ///< the first: the settings as given
    std::vector<KnobRow> knobs;
    std::vector<std::size_t> walk;  ///< trials, from dear to cheap
    std::vector<std::size_t> front; ///< trials that no other beats in time and RMSE, fastest first
    std::vector<RayErrors> rays;
};

/// "40 tiles of 16x16, 3.9 % of the frame's pixels".
[[nodiscard]] std::string sample_text(const Report& report);

struct ExperimentOptions {
    std::optional<double> seconds; ///< processor time per thread that the references may take; else the whole frame is rendered
    std::optional<std::size_t> tiles; ///< so many of 32x32 pixels instead
    std::size_t walk_tiles = 24;
    int repetitions = 5; ///< at most; with `seconds` as many as it grants
    int truth_samples = 16;
    std::size_t rays = 262144;
    FixedKnobs fixed;
    std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// `bench`: all but its sample.
[[nodiscard]] Report run_experiment(Bench bench, const Choice& base, const ExperimentOptions& options);

} // namespace lanecast::trade
