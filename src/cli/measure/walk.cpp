#include "cli/measure/walk.hpp"

#include "cli/settings_options.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace lanecast::trade {
namespace {

/// Repeated until the clock has something to measure: the least of the times counts.
constexpr double least_seconds = 0.02;
constexpr int most_repetitions = 4;
constexpr double noise = 0.03; ///< of times: less than this is no saving

} // namespace

const Step& Laboratory::tried(const Choice& choice) {
    const std::string name = settings_json(choice.settings) + (choice.float_file ? " float" : " half");
    if (const auto found = steps_.find(name); found != steps_.end()) return found->second;
    RenderedSample rendered = render(bench_, choice.settings);
    double seconds = rendered.frame_seconds, spent = rendered.seconds;
    for (int i = 1; i < most_repetitions && spent < least_seconds; ++i) {
        const RenderedSample again = render(bench_, choice.settings);
        seconds = std::min(seconds, again.frame_seconds);
        spent += again.seconds;
    }
    round_as_file(rendered.films, choice.float_file);
    const PictureError error = error_of(rendered.films, reference_, bench_.sample);
    return steps_.emplace(name, Step{choice, error, seconds}).first->second;
}

std::vector<Step> walk(Laboratory& laboratory, const std::vector<Ladder>& ladders, const Choice& from, const Badness& badness,
                       const Accept& accept) {
    std::vector<Step> steps{laboratory.tried(from)};
    for (;;) {
        const Step& now = steps.back();
        std::optional<Step> best;
        double best_price = 0;
        for (const Ladder& ladder : ladders)
            for (const Choice& choice : cheaper(now.choice, ladder)) {
                const Step& next = laboratory.tried(choice);
                if (!accept(next)) continue;
                const double added = badness(next.error) - badness(now.error), saved = std::log(now.seconds / next.seconds);
                const bool free =
                    added <= 0 && ladder.knob != Knob::precision; // where nothing changes, the clock's noise decides nothing
                if (saved < noise && !(free && saved > -noise)) continue;
                const double price = added <= 0 ? added : added / saved;
                if (!best || price < best_price) best = next, best_price = price;
            }
        if (!best) return steps;
        steps.push_back(*best);
    }
}

std::vector<std::size_t> front_of(const std::vector<double>& seconds, const std::vector<double>& errors) {
    std::vector<std::size_t> order(seconds.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return seconds[a] != seconds[b] ? seconds[a] < seconds[b] : errors[a] < errors[b];
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || errors[i] < errors[front.back()]) front.push_back(i);
    return front;
}

} // namespace lanecast::trade
