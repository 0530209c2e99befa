#include "cli/bench/report.hpp"

#include "cli/print.hpp"

#include <algorithm>

namespace lanecast::bench {
namespace {

struct Bar {
    std::string label;
    double value, low, high;
};
struct Group {
    std::string rays;
    std::vector<Bar> bars;
};

constexpr const char* colours[] = {"#4477aa", "#66ccee", "#228833", "#ccbb44", "#ee6677", "#aa3377", "#bbbbbb"};
constexpr double left = 60, top = 60, height = 300, bar = 14, gap = 26, legend = 180, title = 640;

std::vector<Group> groups_of(const Report& report, bool ratios) {
    std::vector<Group> groups;
    for (const Row& row : report.rows) {
        if (!row.ours) continue;
        if (groups.empty() || groups.back().rays != row.rays) groups.push_back({row.rays, {}});
        const Row* const peer = best_peer(report, row);
        if (ratios && peer == nullptr) continue;
        const double unit = ratios ? peer->rate.rays_per_second : 1e6;
        std::string label = row.isa;
        if (row.precision != "balanced") label += " " + row.precision;
        if (row.mode == "quality") label += " quality";
        if (row.threads != 1) label += ", " + std::to_string(row.threads) + " threads";
        groups.back().bars.push_back({label, row.rate.rays_per_second / unit, row.rate.low / unit, row.rate.high / unit});
    }
    return groups;
}

/// 1, 2 or 5 times a power of ten, so that there are four to ten lines.
double grid_step(double largest) {
    double step = 1e-6;
    for (int i = 0; largest / step > 10; ++i) step *= i % 3 == 1 ? 2.5 : 2;
    return step;
}

} // namespace

Drawing plot(const Report& report) {
    const bool ratios = std::any_of(report.rows.begin(), report.rows.end(), [](const Row& row) { return !row.ours; });
    const std::vector<Group> groups = groups_of(report, ratios);
    double largest = 1e-6, width = left;
    std::vector<std::string> labels;
    for (const Group& group : groups) {
        width += gap + bar * static_cast<double>(group.bars.size());
        for (const Bar& b : group.bars) {
            largest = std::max({largest, b.value, b.high});
            if (std::find(labels.begin(), labels.end(), b.label) == labels.end()) labels.push_back(b.label);
        }
    }
    width = std::max(width + gap, left + std::max(legend * static_cast<double>(labels.size()), title));
    const auto y_of = [&](double value) { return top + height * (1 - value / (1.05 * largest)); };

    Drawing drawing{width, top + height + 70, {}, {}};
    const auto line = [&](double x0, double y0, double x1, double y1, const char* colour) {
        drawing.boxes.push_back({x0 - 0.5, y0 - 0.5, x1 - x0 + 1, y1 - y0 + 1, colour});
    };
    const auto peer = std::find_if(report.rows.begin(), report.rows.end(), [](const Row& row) { return !row.ours; });
    drawing.labels.push_back({left, 22,
                              report.mesh + (ratios ? ": rays per second over those of " + peer->library + ", its best mode"
                                                    : ": million rays per second"),
                              Anchor::start, 15});
    drawing.labels.push_back({left, 42, report.cpu + ", " + report.compiler + ", " + report.commit, Anchor::start, 11});
    const double step = grid_step(largest);
    for (int i = 0; i * step <= largest * 1.05; ++i) {
        line(left, y_of(i * step), width - 10, y_of(i * step), "#dddddd");
        drawing.labels.push_back({left - 6, y_of(i * step) + 4, fixed(i * step, step < 1 ? 1 : 0), Anchor::end});
    }
    if (ratios) line(left, y_of(1), width - 10, y_of(1), "#000000");
    double x = left + gap / 2;
    for (const Group& group : groups) {
        const double begin = x;
        for (const Bar& b : group.bars) {
            const auto colour = static_cast<std::size_t>(std::find(labels.begin(), labels.end(), b.label) - labels.begin());
            drawing.boxes.push_back({x, y_of(b.value), bar - 2, y_of(0) - y_of(b.value), colours[colour % std::size(colours)]});
            line(x + bar / 2 - 1, y_of(b.high), x + bar / 2 - 1, y_of(b.low), "#444444");
            x += bar;
        }
        drawing.labels.push_back({(begin + x) / 2, top + height + 18, group.rays});
        x += gap;
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const double place = left + legend * static_cast<double>(i);
        drawing.boxes.push_back({place, top + height + 38, 12, 12, colours[i % std::size(colours)]});
        drawing.labels.push_back({place + 18, top + height + 49, labels[i], Anchor::start});
    }
    return drawing;
}

} // namespace lanecast::bench
