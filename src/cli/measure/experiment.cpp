#include "cli/measure/experiment.hpp"

#include "cli/measure/sampling.hpp"
#include "cli/print.hpp"
#include "cli/settings_options.hpp"
#include "render/dispatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

double squared(double rmse) { return rmse * rmse; }

/// From the dearest settings to the cheapest: at most so many, spread over the logarithm of the time.
void list_walk(Report& report, Laboratory& laboratory) {
    const std::vector<Step> steps = walk(
        laboratory, report.ladders, dearest_choice(report.base, report.ladders),
        [](const PictureError& error) { return squared(error.rmse); }, [](const Step&) { return true; });
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

/// The pictures in double that all errors are measured against.
std::vector<Choice> truths(const Report& report) {
    std::map<std::string, Choice> choices{{text_of(report.truth), report.truth}};
    for (const Ladder& ladder : report.ladders) {
        const Choice choice = with_truth(report, ladder);
        choices.emplace(text_of(choice), choice);
    }
    std::vector<Choice> list;
    for (const auto& [text, choice] : choices) list.push_back(choice);
    return list;
}

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

struct Times {
    std::vector<std::vector<double>> of_frame; ///< processor time, of each repetition of a trial
    double spent = 0;                          ///< on the sample
};

/// All errors, from the first rendering of each trial. What a file rounds away is the error of the knob `file` alone.
Times judge(const Bench& bench, Report& report, const ReferencePicture& reference) {
    Times times{std::vector<std::vector<double>>(report.trials.size())};
    const OwnReferences own = own_references(bench, report);
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        Trial& trial = report.trials[i];
        RenderedSample rendered = render(bench, trial.choice.settings);
        times.of_frame[i].push_back(rendered.frame_seconds);
        times.spent += rendered.seconds;
        trial.rays = rendered.frame_rays;
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
    return times;
}

/// All trials in turn, in every repetition: a machine that slows down slows all of them down. `most_seconds`: no repetition is
/// begun that would probably end later.
void time_trials(const Bench& bench, Report& report, Times times, int repetitions, double most_seconds) {
    const double one = times.spent;
    for (report.repetitions = 1; report.repetitions < repetitions && times.spent + one <= most_seconds; ++report.repetitions)
        for (std::size_t i = 0; i < report.trials.size(); ++i) {
            const RenderedSample rendered = render(bench, report.trials[i].choice.settings);
            times.of_frame[i].push_back(rendered.frame_seconds);
            times.spent += rendered.seconds;
        }
    for (std::size_t i = 0; i < report.trials.size(); ++i) {
        std::vector<double>& seconds = times.of_frame[i];
        std::sort(seconds.begin(), seconds.end());
        Trial& trial = report.trials[i];
        trial.seconds = seconds[seconds.size() / 2];
        trial.low = seconds.front();
        trial.high = seconds.back();
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
    const Choice second = second_truth(report.truth, report.ladders);
    const RenderedSample rendered = render(bench, second.settings);
    report.second_choice = describe(second, report.ladders);
    report.second = error_of(rendered.films, reference, bench.sample);
}

TileSample sample_of(const Bench& bench, const Report& report, const ExperimentOptions& options) {
    if (options.tiles) return spread_tiles(bench.options, *options.tiles);
    if (!options.seconds) return every_tile(bench.options);
    return affordable_sample(bench, truths(report), report.truth, report.ladders,
                             {.seconds = *options.seconds, .least_tiles = 32, .most_tiles = 1024}, squared);
}

} // namespace

std::string sample_text(const Report& report) {
    const std::string size = std::to_string(report.tile_size);
    return report.whole ? "every tile"
                        : counted(report.tiles, "tile") + " of " + size + "x" + size + ", " + fixed(100 * report.share, 1) +
                              " % of the frame's pixels";
}

Report run_experiment(Bench bench, const Choice& base, const ExperimentOptions& options) {
    Report report;
    report.base = base;
    report.ladders = make_ladders(*bench.scene, base, options.fixed, bench.isa, options.truth_samples);
    bound_truth(bench, base, report.ladders);
    report.truth = true_choice(base, report.ladders);
    bench.sample = sample_of(bench, report, options);
    report.width = bench.sample.width;
    report.height = bench.sample.height;
    report.threads = bench.options.threads;
    report.tiles = bench.sample.tiles.size();
    report.tile_size = bench.sample.tile_size;
    report.whole = bench.sample.windows.size() == 1;
    report.share = bench.sample.pixels() / bench.sample.frame_pixels;
    add_trial(report, base);
    list_knobs(report);

    options.say("the reference: " + describe(report.truth, report.ladders) + "; " + sample_text(report));
    const ReferencePicture reference = render_reference(bench, report.truth);
    report.truth_seconds = reference.frame_seconds;
    judge_truth(bench, report, reference);

    Bench spread = bench;
    if (report.whole) spread.sample = spread_tiles(bench.options, options.walk_tiles);
    options.say("looking for good combinations on " + counted(spread.sample.tiles.size(), "tile"));
    Laboratory laboratory(spread, cut(reference, spread.sample));
    list_walk(report, laboratory);

    options.say(counted(report.trials.size(), "choice") + ", up to " + std::to_string(options.repetitions) + " times each");
    Times times = judge(bench, report, reference);
    const double most_seconds =
        options.seconds ? *options.seconds * bench.options.threads : std::numeric_limits<double>::infinity();
    time_trials(bench, report, std::move(times), options.repetitions, most_seconds);
    time_files(bench, report, reference);
    std::vector<double> seconds, errors;
    for (const Trial& trial : report.trials) {
        seconds.push_back(trial.total());
        errors.push_back(trial.error.rmse);
    }
    report.front = front_of(seconds, errors);

    options.say("single rays");
    Bench frame = bench; // their rates are of the frame, too
    frame.sample = every_tile(bench.options);
    const RayLists rays = collect_rays(frame, base.settings, options.rays);
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
