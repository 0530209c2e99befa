#include "cli/measure/budget.hpp"

#include "cli/measure/sampling.hpp"
#include "cli/print.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace lanecast::trade {
namespace {

constexpr double reference_seconds = 5; ///< processor time per thread that the reference may take
constexpr std::size_t least_tiles = 64, most_tiles = 160;
/// Per side of a pixel of the reference; the finer ones only where the coarser are too uncertain. 11 has no sample but the centre
/// in common with any of the choices.
constexpr int truth_samples[] = {11, 16};
constexpr double hopeless = 2; ///< where the coarser is less certain than this multiple of a bound, so is the finer
/// What the largest error of a frame may add to that of a small part of it, as a multiple. Met, where tiles are drawn where
/// errors are: 0.7, and 1.1 of mirrors in mirrors, whose reference is uncertain, too (docs/accuracy.md).
constexpr double unseen_maximum = 1;

/// The error of a step, as the frame may have it.
struct Judge {
    ErrorMetric metric;
    PictureError second; ///< of another picture of the truth
    double share;        ///< of the frame that is sampled

    [[nodiscard]] double expected(const PictureError& e) const {
        return metric == ErrorMetric::rmse ? e.rmse : metric == ErrorMetric::max ? e.largest : e.flip;
    }
    /// Of the reference itself: the second picture, of two thirds of the samples, has about twice its error.
    [[nodiscard]] double uncertain() const { return expected(second) / 2; }
    [[nodiscard]] double at_most(const PictureError& e) const {
        switch (metric) {
        case ErrorMetric::rmse:
            return std::hypot(e.rmse_above, uncertain());
        case ErrorMetric::max:
            return e.largest * (1 + unseen_maximum * (1 - share)) + uncertain();
        case ErrorMetric::flip:
            return e.flip_above + uncertain();
        }
        return 0;
    }
    /// What adds up.
    [[nodiscard]] double badness(const PictureError& e) const {
        return metric == ErrorMetric::flip ? e.flip : expected(e) * expected(e);
    }
};

struct Search {
    std::vector<Ladder> ladders;
    Choice truth;
    Laboratory laboratory;
    Judge judge;
};

[[nodiscard]] Search prepare(Bench bench, const Choice& base, const FixedKnobs& fixed, const Budget& budget, int samples) {
    std::vector<Ladder> ladders = make_ladders(*bench.scene, base, fixed, bench.isa, samples);
    bound_truth(bench, base, ladders);
    const Choice truth = true_choice(base, ladders);
    bench.sample = affordable_sample(bench, {truth}, truth, ladders,
                                     {.seconds = reference_seconds, .least_tiles = least_tiles, .most_tiles = most_tiles},
                                     [&](double rmse) { return budget.metric == ErrorMetric::flip ? rmse : rmse * rmse; });
    Laboratory laboratory(bench, render_reference(bench, truth));
    const RenderedSample second = render(bench, second_truth(truth, ladders).settings);
    const PictureError apart = error_of(second.films, laboratory.reference(), bench.sample);
    return {std::move(ladders),
            truth,
            std::move(laboratory),
            {budget.metric, apart, bench.sample.pixels() / bench.sample.frame_pixels}};
}

/// Knobs of the frame; what the file holds is decided apart, because it takes no time of the frame.
[[nodiscard]] std::vector<Ladder> without_file(const std::vector<Ladder>& ladders) {
    std::vector<Ladder> rest;
    std::ranges::copy_if(ladders, std::back_inserter(rest), [](const Ladder& l) { return l.knob != Knob::file; });
    return rest;
}

[[nodiscard]] bool turns_file(const std::vector<Ladder>& ladders) {
    return std::ranges::find(ladders, Knob::file, &Ladder::knob) != ladders.end();
}

/// The truth as far as knobs may be turned; its numbers by what has them sooner than the reference.
[[nodiscard]] Choice attainable_truth(const Search& search, const Choice& base) {
    Choice choice = search.truth;
    if (!turns_file(search.ladders)) choice.float_file = base.float_file;
    choice.settings.precision = base.settings.precision;
    for (const Ladder& ladder : search.ladders) {
        if (ladder.knob != Knob::precision) continue;
        for (const KnobValue& value : ladder.values) value.set(choice); // the last is the most precise
    }
    return choice;
}

[[nodiscard]] Step within_error(Search& search, const Choice& base, const Budget& budget) {
    const double limit = *budget.max_error;
    const Judge& judge = search.judge;
    const auto accept = [&](const Step& step) { return judge.at_most(step.error) <= limit; };
    const auto require = [&](bool kept) {
        if (!kept)
            throw Error(ExitCode::usage, "--max-error " + number_text(limit) +
                                             ": no settings are known to keep it; the reference itself is certain to " +
                                             short_error(judge.uncertain()));
    };
    require(judge.uncertain() <= limit);
    Choice from = dearest_choice(base, search.ladders);
    if (turns_file(search.ladders)) {
        from.float_file = false;
        // halves where their rounding is a small part of the error
        if (judge.at_most(search.laboratory.tried(from).error) > 0.7 * limit) from.float_file = true;
    }
    if (!accept(search.laboratory.tried(from))) from = attainable_truth(search, base);
    require(accept(search.laboratory.tried(from)));
    const auto badness = [&](const PictureError& e) { return judge.badness(e); };
    Step best = walk(search.laboratory, without_file(search.ladders), from, badness, accept).back();
    search.laboratory.for_each([&](const Step& step) { // also what the walk passed by
        if (accept(step) && step.seconds < best.seconds) best = step;
    });
    return best;
}

[[nodiscard]] Step within_time(Search& search, const Choice& base, const Budget& budget, double threads) {
    const double limit = *budget.max_seconds;
    Choice from = dearest_choice(base, search.ladders);
    const std::vector<Step> steps = walk(
        search.laboratory, without_file(search.ladders), from, [&](const PictureError& e) { return search.judge.badness(e); },
        [](const Step&) { return true; });
    const auto in_time = [&](const Step& step) { return step.seconds / threads <= limit; };
    const Step* best = nullptr;
    search.laboratory.for_each([&](const Step& step) {
        const bool better = best == nullptr || search.judge.expected(step.error) < search.judge.expected(best->error);
        if (in_time(step) && better) best = &step;
    });
    if (best != nullptr) return *best;
    throw Error(ExitCode::usage, "--max-time " + number_text(limit) +
                                     ": no settings are that fast; the fastest tried takes about " +
                                     short_seconds(steps.back().seconds / threads));
}

} // namespace

Pick pick_settings(Bench bench, const Choice& base, const FixedKnobs& fixed, const Budget& budget) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    Search search = prepare(bench, base, fixed, budget, truth_samples[0]);
    const bool sampled = !fixed[Knob::anti_aliasing];
    if (budget.max_error && sampled && search.judge.uncertain() > *budget.max_error / 4)
        search = prepare(bench, base, fixed, budget, truth_samples[1]);
    const TileSample& sample = search.laboratory.bench().sample;
    const double threads = std::min<double>(bench.options.threads, static_cast<double>(sample.tiles.size()));
    const Step step = budget.max_error ? within_error(search, base, budget) : within_time(search, base, budget, threads);
    Pick pick;
    pick.choice = step.choice;
    pick.expected = search.judge.expected(step.error);
    pick.at_most = search.judge.at_most(step.error);
    pick.seconds = step.seconds / threads;
    pick.tiles = sample.tiles.size();
    pick.trials = search.laboratory.trials();
    pick.search_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    pick.description = describe(step.choice, search.ladders);
    pick.reference = as_options(search.truth);
    return pick;
}

std::string as_options(const Choice& choice) {
    const RenderSettings& s = choice.settings;
    const AntiAliasMode mode = s.anti_aliasing.mode;
    const std::string aa = label_of(Knob::anti_aliasing, choice);
    std::string text = "--precision " + label_of(Knob::precision, choice) + " --aa " + aa.substr(0, aa.find(' '));
    if (mode == AntiAliasMode::edge || mode == AntiAliasMode::grid)
        text += " --aa-samples " + std::to_string(s.anti_aliasing.samples);
    text += " --soft-shadows " + label_of(Knob::soft_shadows, choice) + " --depth " + label_of(Knob::depth, choice) +
            " --cutoff " + label_of(Knob::cutoff, choice);
    return text + (choice.float_file ? " --float" : "");
}

} // namespace lanecast::trade
