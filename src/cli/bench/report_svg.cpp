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
constexpr double left = 60, top = 60, height = 300, bar = 14, gap = 26;

std::string number(double value) { return fixed(value, 1); }

std::string text_at(double x, double y, const std::string& text, const char* anchor = "middle", int size = 12) {
    return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" font-size=\"" +
           std::to_string(size) + "\">" + text + "</text>\n";
}
std::string line_at(double x0, double y0, double x1, double y1, const char* colour) {
    return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) + "\" y2=\"" + number(y1) +
           "\" stroke=\"" + colour + "\"/>\n";
}

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

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    return safe;
}

} // namespace

std::string svg_report(const Report& report) {
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
    width = std::max(width + gap, left + 180 * static_cast<double>(labels.size()));
    const auto y_of = [&](double value) { return top + height * (1 - value / (1.05 * largest)); };

    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
                      number(top + height + 70) +
                      "\" font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    const auto peer = std::find_if(report.rows.begin(), report.rows.end(), [](const Row& row) { return !row.ours; });
    svg += text_at(left, 22,
                   escaped(report.mesh + (ratios ? ": rays per second over those of " + peer->library + ", its best mode"
                                                 : ": million rays per second")),
                   "start", 15);
    svg += text_at(left, 42, escaped(report.cpu + ", " + report.compiler + ", " + report.commit), "start", 11);
    const double step = grid_step(largest);
    for (int i = 0; i * step <= largest * 1.05; ++i) {
        svg += line_at(left, y_of(i * step), width - 10, y_of(i * step), "#dddddd");
        svg += text_at(left - 6, y_of(i * step) + 4, fixed(i * step, step < 1 ? 1 : 0), "end");
    }
    if (ratios) svg += line_at(left, y_of(1), width - 10, y_of(1), "#000000");
    double x = left + gap / 2;
    for (const Group& group : groups) {
        const double begin = x;
        for (const Bar& b : group.bars) {
            const auto colour = static_cast<std::size_t>(std::find(labels.begin(), labels.end(), b.label) - labels.begin());
            svg += "<rect x=\"" + number(x) + "\" y=\"" + number(y_of(b.value)) + "\" width=\"" + number(bar - 2) +
                   "\" height=\"" + number(y_of(0) - y_of(b.value)) + "\" fill=\"" + colours[colour % std::size(colours)] +
                   "\"/>\n";
            svg += line_at(x + bar / 2 - 1, y_of(b.low), x + bar / 2 - 1, y_of(b.high), "#444444");
            x += bar;
        }
        svg += text_at((begin + x) / 2, top + height + 18, group.rays);
        x += gap;
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const double place = left + 180 * static_cast<double>(i);
        svg += "<rect x=\"" + number(place) + "\" y=\"" + number(top + height + 38) + "\" width=\"12\" height=\"12\" fill=\"" +
               colours[i % std::size(colours)] + "\"/>\n" + text_at(place + 18, top + height + 49, labels[i], "start");
    }
    return svg + "</svg>\n";
}

} // namespace lanecast::bench
