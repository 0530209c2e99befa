#include "cli/measure/report.hpp"

#include "cli/print.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::trade {
namespace {

using bench::Anchor;
using bench::Drawing;

constexpr double left = 70, top = 60, width = 640, height = 420, legend = 170;
constexpr const char* knob_colours[knob_count] = {"#4477aa", "#ee6677", "#228833", "#ccbb44", "#aa3377", "#66ccee"};
constexpr const char* walk_colour = "#888888";
constexpr const char* front_colour = "#000000";

/// Whole decades around the values.
struct LogAxis {
    double low, high; ///< exponents of ten
    [[nodiscard]] double share(double value) const { return (std::log10(value) - low) / (high - low); }
};

LogAxis axis_of(const std::vector<double>& values) {
    double least = 1e300, most = 0;
    for (const double v : values) {
        if (!(v > 0) || !std::isfinite(v)) continue;
        least = std::min(least, v), most = std::max(most, v);
    }
    if (most == 0) return {-1, 0};
    const double low = std::floor(std::log10(least)), high = std::ceil(std::log10(most));
    return {low, std::max(high, low + 1)};
}

std::string power_of_ten(int exponent) {
    return exponent >= -3 && exponent <= 3 ? fixed(std::pow(10, exponent), std::max(0, -exponent))
                                           : "1e" + std::to_string(exponent);
}

struct Frame {
    LogAxis time, error;
    [[nodiscard]] double x(double seconds) const { return left + width * std::clamp(time.share(seconds), 0.0, 1.0); }
    /// An error of zero lies on the lower border.
    [[nodiscard]] double y(double e) const {
        return e > 0 ? top + height * (1 - std::clamp(error.share(e), 0.0, 1.0)) : top + height;
    }
};

void add_line(Drawing& drawing, double x0, double y0, double x1, double y1, const char* colour, double thick = 1) {
    const double lx = std::min(x0, x1), ly = std::min(y0, y1);
    drawing.boxes.push_back({lx - thick / 2, ly - thick / 2, std::abs(x1 - x0) + thick, std::abs(y1 - y0) + thick, colour});
}

void add_grid(Drawing& drawing, const Frame& frame) {
    for (int e = static_cast<int>(frame.time.low); e <= static_cast<int>(frame.time.high); ++e) {
        const double x = frame.x(std::pow(10, e));
        add_line(drawing, x, top, x, top + height, "#dddddd");
        drawing.labels.push_back({x, top + height + 16, power_of_ten(e) + " s"});
    }
    for (int e = static_cast<int>(frame.error.low); e <= static_cast<int>(frame.error.high); ++e) {
        const double y = frame.y(std::pow(10, e));
        add_line(drawing, left, y, left + width, y, "#dddddd");
        drawing.labels.push_back({left - 6, y + 4, power_of_ten(e), Anchor::end});
    }
}

} // namespace

Drawing plot(const Report& report) {
    std::vector<double> seconds, errors;
    for (const Trial& trial : report.trials) {
        seconds.push_back(trial.total());
        errors.push_back(trial.error.rmse);
    }
    const Frame frame{axis_of(seconds), axis_of(errors)};
    Drawing drawing{left + width + legend, top + height + 50, {}, {}};
    drawing.labels.push_back(
        {left, 22, report.scene + ": RMSE against the reference, and processor time of a frame and its file", Anchor::start, 15});
    drawing.labels.push_back({left, 42, preamble(report)[1], Anchor::start, 11});
    add_grid(drawing, frame);
    const auto dot = [&](double x, double y, const char* colour, double size) {
        drawing.boxes.push_back({x - size / 2, y - size / 2, size, size, colour});
    };
    for (std::size_t i = 0; i < report.front.size(); ++i) { // what is up and right of the steps can be beaten
        const Trial& now = report.trials[report.front[i]];
        const double x = frame.x(now.total()), y = frame.y(now.error.rmse);
        const double before = i == 0 ? top : frame.y(report.trials[report.front[i - 1]].error.rmse);
        add_line(drawing, x, before, x, y, front_colour, 1.5);
        const double after = i + 1 < report.front.size() ? frame.x(report.trials[report.front[i + 1]].total()) : left + width;
        add_line(drawing, x, y, after, y, front_colour, 1.5);
    }
    const double floor = frame.y(report.second.rmse);
    if (report.second.rmse > 0 && floor < top + height) {
        add_line(drawing, left, floor, left + width, floor, "#cc8888");
        drawing.labels.push_back({left + 4, floor - 3, "a second reference picture differs by this much", Anchor::start, 10});
    }
    for (const std::size_t i : report.walk) dot(frame.x(seconds[i]), frame.y(errors[i]), walk_colour, 7);
    for (const KnobRow& row : report.knobs)
        if (!row.given) dot(frame.x(seconds[row.trial]), frame.y(errors[row.trial]), knob_colours[static_cast<int>(row.knob)], 8);
    dot(frame.x(seconds[0]), frame.y(errors[0]), front_colour, 11);

    double y = top + 10;
    const auto name = [&](const char* colour, const std::string& text) {
        drawing.boxes.push_back({left + width + 16, y - 9, 10, 10, colour});
        drawing.labels.push_back({left + width + 32, y, text, Anchor::start});
        y += 20;
    };
    for (const Ladder& ladder : report.ladders) name(knob_colours[static_cast<int>(ladder.knob)], name_of(ladder.knob));
    name(walk_colour, "combinations");
    name(front_colour, "as given; front");
    return drawing;
}

} // namespace lanecast::trade
