#pragma once
// --max-error, --error-metric and --max-time, and what commands with trials of settings have in common.

#include "cli/frame_request.hpp"
#include "cli/measure/budget.hpp"

namespace lanecast::trade {

void add_budget_options(CLI::App& command, Budget& budget);
[[nodiscard]] bool is_given(const Budget& budget);

/// What the command line sets by hand; `float_file`: it asks for floats.
[[nodiscard]] FixedKnobs fixed_by(const FrameRequest& request, bool float_file);

/// As `flatten_requested`, with soft shadows ready to be tried unless they are fixed.
[[nodiscard]] SceneArrays flatten_for_trials(const FrameRequest& request, RequestedScene& scene, const FixedKnobs& fixed);

/// pick_settings, telling the user what it does and what it picked.
[[nodiscard]] Pick pick_and_say(const Bench& bench, const Choice& base, const FixedKnobs& fixed, const Budget& budget,
                                bool quiet);

/// For the picture's attributes: "max-error 0.01 rmse: expected 0.008, ...".
[[nodiscard]] std::string record_of(const Pick& pick, const Budget& budget);

} // namespace lanecast::trade
