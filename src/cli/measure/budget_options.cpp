#include "cli/measure/budget_options.hpp"

#include "cli/number_option.hpp"
#include "cli/print.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <iterator>

#include <CLI/CLI.hpp>

namespace lanecast::trade {
namespace {

constexpr KeySpec error_key{.name = "error", .range = {.low = 0, .low_open = true}};
constexpr KeySpec time_key{.name = "time", .range = {.low = 0, .high = 1e9, .low_open = true}};

/// "max-error 0.01 rmse"
[[nodiscard]] std::string words_of(const Budget& budget) {
    return budget.max_error ? "max-error " + number_text(*budget.max_error) + " " + metric_names[static_cast<int>(budget.metric)]
                            : "max-time " + number_text(*budget.max_seconds);
}

/// "RMSE 0.0031 (at most 0.0042), 84.1 ms"
[[nodiscard]] std::string expectation(const Pick& pick, const Budget& budget) {
    constexpr const char* names[] = {"RMSE", "largest error", "FLIP"};
    return std::string(names[static_cast<int>(budget.metric)]) + " " + short_error(pick.expected) + " (at most " +
           short_error(pick.at_most) + "), " + short_seconds(pick.seconds);
}

} // namespace

void add_budget_options(CLI::App& command, Budget& budget) {
    constexpr const char* group = "Budgets (settings that are not given are picked)";
    CLI::Option* const error =
        add_number_option(command, "--max-error",
                          "Pick the fastest settings that keep the error of linear RGB below X, by trials on some tiles",
                          error_key, [&budget](double value) { budget.max_error = value; })
            ->group(group);
    command
        .add_option_function<std::string>(
            "--error-metric",
            [&budget](const std::string& text) {
                const auto* const found = std::ranges::find(metric_names, text);
                if (found == std::end(metric_names))
                    throw CLI::ValidationError("--error-metric", "must be rmse, max or flip, got '" + text + "'");
                budget.metric = static_cast<ErrorMetric>(found - std::begin(metric_names));
            },
            "What the error is: root of the mean square, largest difference of a channel, or mean FLIP; default rmse")
        ->type_name("rmse|max|flip")
        ->needs(error)
        ->group(group);
    add_number_option(command, "--max-time", "Pick the settings with the least error whose frame takes at most X seconds",
                      time_key, [&budget](double value) { budget.max_seconds = value; })
        ->group(group)
        ->excludes(error);
}

bool is_given(const Budget& budget) { return budget.max_error || budget.max_seconds; }

FixedKnobs fixed_by(const FrameRequest& request, bool float_file) {
    FixedKnobs fixed = fixed_knobs([&](const RenderSettings& settings) { return changed(settings, request.changes); });
    fixed[Knob::file] = float_file;
    return fixed;
}

SceneArrays flatten_for_trials(const FrameRequest& request, RequestedScene& scene, const FixedKnobs& fixed) {
    const int own = scene.settings.soft_shadows;
    if (!fixed[Knob::soft_shadows]) scene.settings.soft_shadows = std::max(own, 1);
    SceneArrays arrays = flatten_requested(request, scene);
    scene.settings.soft_shadows = own;
    return arrays;
}

Pick pick_and_say(const Bench& bench, const Choice& base, const FixedKnobs& fixed, const Budget& budget, bool quiet) {
    if (!quiet) print_message("looking for settings: " + words_of(budget));
    Pick pick = pick_settings(bench, base, fixed, budget);
    if (quiet) return pick;
    print_message("picked " + pick.description + ": expected " + expectation(pick, budget) + "; of " +
                  counted(pick.trials, "choice") + " on " + counted(pick.tiles, "tile") + " in " +
                  short_seconds(pick.search_seconds));
    print_message("reference: " + pick.reference + "; the same again: " + as_options(pick.choice));
    return pick;
}

std::string record_of(const Pick& pick, const Budget& budget) {
    return words_of(budget) + ": expected " + expectation(pick, budget) + "; reference: " + pick.reference + "; " +
           as_options(pick.choice);
}

} // namespace lanecast::trade
