#include "cli/measure/experiment.hpp"

#include "cli/print.hpp"
#include "cli/settings_options.hpp"
#include "render/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace lanecast::trade {
namespace {

constexpr std::size_t most_walked = 16; ///< steps of the walk that are measured again, with all repetitions

std::string text_of(const Choice& choice) { return settings_json(choice.settings) + (choice.float_file ? " float" : " half"); }

std::size_t add_trial(Report& report, const Choice& choice) {
    for (std::size_t i = 0; i < report.trials.size(); ++i)
        if (text_of(report.trials[i].choice) == text_of(choice)) return i;
    report.trials.push_back({.choice = choice, .error = {}});
    return report.trials.size() - 1;
}

void list_knobs(Report& report) {
    for (const Ladder& ladder : report.ladders) {
        std::vector<KnobValue> values = ladder.values;
        if (ladder.knob == Knob::precision) values.push_back(ladder.truth); // its truth is a preset like the others
        for (const KnobValue& value : values) {
            Choice choice = report.base;
            value.set(choice);
            const bool given = label_of(ladder.knob, report.base) == value.label;
            choice = bounded(choice, report.base, report.truth);
            report.knobs.push_back({ladder.knob, value.label, given, add_trial(report, choice), {}});
        }
    }
}

double squared_rmse(const PictureError& error) { return error.rmse * error.rmse; }

/// From the dearest settings to the cheapest: at most so many, spread over the logarithm of the time.
void list_walk(Report& report, Laboratory& laboratory) {
    const std::vector<Step> steps = walk(laboratory, report.ladders, dearest_choice(report.base, report.ladders), squared_rmse,
                                         [](const Step&) { return true; });
    const double most = std::log(steps.front().seconds), least = std::log(steps.back().seconds);
    double next = most;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double at = std::log(steps[i].seconds);
        if (at > next && i + 1 < steps.size()) continue;
        report.walk.push_back(add_trial(report, steps[i].choice));
        next = std::min(next, at) - (most - least) / most_walked;
    }
}

Choice with_truth(const Report& report, const Ladder& ladder) {
    Choice choice = report.base;
    ladder.alone.set(choice);
    choice = bounded(choice, report.base, report.truth);
    choice.settings.precision = Precision::reference;
    choice.float_file = true;
    return choice;
}

/// The truths of single knobs; knobs with the same one share it.
struct OwnReferences {
    std::map<std::string, ReferencePicture> pictures;
    std::map<Knob, const ReferencePicture*> of;
};

OwnReferences own_references(const Bench& bench, const Report& report) {
    OwnReferences own;
    for (const Ladder& ladder : report.ladders) {
        const Choice choice = with_truth(report, ladder);
        const auto [at, made] = own.pictures.try_emplace(text_of(choice));
        if (made) at->second = render_reference(bench, choice);
        own.of[ladder.knob] = &at->second;
    }
    return own;
}

/// All errors, from one rendering of each trial. What a file rounds away is the error of the knob `file` alone.
void judge(const Bench& bench, Report& report, const ReferencePicture& reference) {
    const OwnReferences own = own_references(bench, report);
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        Trial& trial = report.trials[i];
        RenderedSample rendered = render(bench, trial.choice.settings);
        trial.rays = static_cast<double>(ray_count(rendered.stats)) * frame_scale(bench.sample);
        const auto judge_rows = [&](bool of_file) {
            for (KnobRow& row : report.knobs)
                if (row.trial == i && (row.knob == Knob::file) == of_file)
                    row.own = error_of(rendered.films, *own.of.at(row.knob), bench.sample);
        };
        judge_rows(false);
        round_as_file(rendered.films, trial.choice.float_file);
        judge_rows(true);
        trial.error = error_of(rendered.films, reference, bench.sample);
    }
}

/// All trials in turn, in every repetition: a machine that slows down slows all of them down.
void time_trials(const Bench& bench, Report& report) {
    std::vector<std::vector<double>> seconds(report.trials.size());
    for (int r = 0; r < report.repetitions; ++r)
        for (std::size_t i = 0; i < report.trials.size(); ++i)
            seconds[i].push_back(render(bench, report.trials[i].choice.settings).seconds * frame_scale(bench.sample));
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        std::sort(seconds[i].begin(), seconds[i].end());
        Trial& trial = report.trials[i];
        trial.seconds = seconds[i][seconds[i].size() / 2];
        trial.low = seconds[i].front();
        trial.high = seconds[i].back();
    }
}

void time_files(const Bench& bench, Report& report, const ReferencePicture& reference) {
    double seconds[2] = {1e30, 1e30}; // the least of a few
    for (int r = 0; r < std::max(report.repetitions, 3); ++r)
        for (const bool floats : {false, true})
            seconds[floats ? 1 : 0] = std::min(seconds[floats ? 1 : 0], time_of_file(bench, reference.films, floats));
    for (Trial& trial : report.trials) trial.file_seconds = seconds[trial.choice.float_file ? 1 : 0];
}

void judge_truth(const Bench& bench, Report& report, const ReferencePicture& reference) {
    const Choice second = second_truth(report.truth);
    const RenderedSample rendered = render(bench, second.settings);
    report.second_choice = describe(second, report.ladders);
    report.second = error_of(rendered.films, reference, bench.sample);
}

} // namespace

Report run_experiment(Bench bench, const Choice& base, const ExperimentOptions& options) {
    bench.sample = options.tiles == 0 ? every_tile(bench.options) : spread_tiles(bench.options, options.tiles);
    Report report;
    report.width = bench.sample.width;
    report.height = bench.sample.height;
    report.threads = bench.options.threads;
    report.repetitions = options.repetitions;
    report.tiles = bench.sample.tiles.size();
    report.whole = bench.sample.windows.size() == 1;
    report.share = bench.sample.pixels() / bench.sample.frame_pixels;
    report.base = base;
    report.ladders = make_ladders(*bench.scene, base, options.fixed, bench.isa, options.truth_samples);
    bound_truth(bench, base, report.ladders);
    report.truth = true_choice(base, report.ladders);
    add_trial(report, base);
    list_knobs(report);

    options.say("the reference: " + describe(report.truth, report.ladders));
    const ReferencePicture reference = render_reference(bench, report.truth);
    report.truth_seconds = reference.seconds * frame_scale(bench.sample);
    judge_truth(bench, report, reference);

    Bench spread = bench;
    if (report.whole) spread.sample = spread_tiles(bench.options, options.walk_tiles);
    options.say("looking for good combinations on " + counted(spread.sample.tiles.size(), "tile"));
    Laboratory laboratory(spread, cut(reference, spread.sample));
    list_walk(report, laboratory);

    options.say(counted(report.trials.size(), "choice") + ", " + std::to_string(options.repetitions) + " times each");
    judge(bench, report, reference);
    time_trials(bench, report);
    time_files(bench, report, reference);
    std::vector<double> seconds, errors;
    for (const Trial& trial : report.trials) {
        seconds.push_back(trial.total());
        errors.push_back(trial.error.rmse);
    }
    report.front = front_of(seconds, errors);

    options.say("single rays");
    const RayLists rays = collect_rays(bench, base.settings, options.rays);
    const Ladder presets = make_ladders(*bench.scene, base, {}, bench.isa, options.truth_samples).front();
    for (const KnobValue& preset : presets.values) {
        Choice choice;
        preset.set(choice);
        const std::vector<RayErrors> rows =
            ray_errors(bench, rays, find_kernels(bench.isa, choice.settings.precision), preset.label);
        report.rays.insert(report.rays.end(), rows.begin(), rows.end());
    }
    return report;
}

} // namespace lanecast::trade
