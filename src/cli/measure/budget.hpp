#pragma once
// The settings that keep an error, or a time, with the least of the other: found by trying them on a spread of tiles.

#include "cli/measure/walk.hpp"

#include <optional>
#include <string>

namespace lanecast::trade {

enum class ErrorMetric { rmse, max, flip };
inline constexpr const char* metric_names[] = {"rmse", "max", "flip"};

struct Budget {
    std::optional<double> max_error;
    ErrorMetric metric = ErrorMetric::rmse;
    std::optional<double> max_seconds; ///< of the frame, first ray to finished film; either this or max_error
};

struct Pick {
    Choice choice;
    double expected = 0; ///< in the budget's metric, on the sample
    double at_most = 0;  ///< what the frame is expected to keep: the sample's spread and the reference's own error added
    double seconds = 0;  ///< of the frame, with the threads there are
    std::size_t tiles = 0, trials = 0;
    double search_seconds = 0;
    std::string description; ///< of the knobs that were turned
    std::string reference;   ///< what the error is measured against, as options
};

/// `bench`: all but its sample. Throws Error (usage) where nothing keeps the budget.
[[nodiscard]] Pick pick_settings(Bench bench, const Choice& base, const FixedKnobs& fixed, const Budget& budget);

/// "--precision balanced --aa edge ...": options that give these settings whatever the scene's own are.
[[nodiscard]] std::string as_options(const Choice& choice);

} // namespace lanecast::trade
