#include "cli/measure/report.hpp"

#include "cli/print.hpp"

#include <algorithm>

namespace lanecast::trade {
namespace {

std::string padded(const std::string& text, std::size_t width, bool left) {
    const std::string space(text.size() < width ? width - text.size() : 0, ' ');
    return left ? text + space : space + text;
}

/// "2.3 ms", and half the range of the repetitions as a share of it.
std::vector<std::string> times(const Trial& trial) {
    const double spread = trial.seconds > 0 ? 50 * (trial.high - trial.low) / trial.seconds : 0;
    return {short_seconds(trial.seconds), "+-" + fixed(spread, 0) + "%", short_seconds(trial.file_seconds)};
}

std::vector<std::string> errors(const PictureError& error) {
    return {short_error(error.rmse), short_error(error.relmse), short_error(error.largest), fixed(100 * error.off, 2),
            short_error(error.flip)};
}

void append(std::vector<std::string>& row, const std::vector<std::string>& more) {
    row.insert(row.end(), more.begin(), more.end());
}

const std::vector<std::string> error_head{"RMSE", "relMSE", "largest", "off %", "FLIP"};

Table knob_table(const Report& report) {
    Table table{.title = "Knobs, one at a time",
                .note =
                    "The other knobs as the scene has them (*). own: against the same settings with this knob at its truth, by "
                    "the reference; then against the reference picture. Deeper than the scene's own, the cutoff is at least "
                    "the reference's. >: on the front",
                .head = {"knob", "value", "", "frame", "", "file", "own RMSE", "own FLIP"},
                .rows = {},
                .words = 3};
    append(table.head, error_head);
    for (const KnobRow& knob : report.knobs) {
        const Trial& trial = report.trials[knob.trial];
        std::vector<std::string> row{name_of(knob.knob), knob.value,
                                     std::string(knob.given ? "*" : " ") + (is_on_front(report, knob.trial) ? ">" : "")};
        append(row, times(trial));
        append(row, {short_error(knob.own.rmse), short_error(knob.own.flip)});
        append(row, errors(trial.error));
        table.rows.push_back(row);
    }
    return table;
}

Table trial_table(const Report& report, const std::string& title, const std::string& note,
                  const std::vector<std::size_t>& trials) {
    Table table{.title = title, .note = note, .head = {"settings", "", "frame", "", "file"}, .rows = {}, .words = 2};
    append(table.head, error_head);
    for (const std::size_t i : trials) {
        const Trial& trial = report.trials[i];
        std::vector<std::string> row{describe(trial.choice, report.ladders), is_on_front(report, i) ? ">" : ""};
        append(row, times(trial));
        append(row, errors(trial.error));
        table.rows.push_back(row);
    }
    return table;
}

/// "precision fast; soft shadows 1, 2".
std::string unused_text(const Report& report) {
    std::string text;
    for (const Ladder& ladder : report.ladders) {
        std::string values;
        for (const std::string& value : unused_values(report, ladder)) values += (values.empty() ? " " : ", ") + value;
        if (!values.empty()) text += (text.empty() ? "" : "; ") + std::string(name_of(ladder.knob)) + values;
    }
    return text.empty() ? "nothing" : text;
}

Table ray_table(const Report& report) {
    Table table{.title = "Single rays, against the reference",
                .note = "Per million rays: missed, false hits, another object (ties within 4 ulp apart). t in units of its last "
                        "place, normals in radians, where both hit the same",
                .head = {"precision", "isa", "rays", "count", "missed", "false", "wrong", "t p50", "p99", "max", "normal p50",
                         "p99", "max"},
                .rows = {},
                .words = 3};
    for (const RayErrors& r : report.rays) {
        const auto per_million = [&](std::size_t n) {
            const double rate = 1e6 * static_cast<double>(n) / static_cast<double>(r.count);
            return n == 0 ? std::string("0") : fixed(rate, rate < 100 ? 1 : 0);
        };
        std::vector<std::string> row{
            r.precision, r.isa, name_of(r.rays), std::to_string(r.count), per_million(r.missed), per_million(r.false_hits)};
        if (r.rays == RayClass::shadow)
            append(row, std::vector<std::string>(7, "-"));
        else
            append(row, {per_million(r.wrong_object), fixed(r.ulp_p50, 0), fixed(r.ulp_p99, 0), fixed(r.ulp_max, 0),
                         short_error(r.angle_p50), short_error(r.angle_p99), short_error(r.angle_max)});
        table.rows.push_back(row);
    }
    return table;
}

} // namespace

bool is_on_front(const Report& report, std::size_t trial) {
    return std::find(report.front.begin(), report.front.end(), trial) != report.front.end();
}

std::vector<std::string> unused_values(const Report& report, const Ladder& ladder) {
    std::vector<std::string> unused;
    for (const KnobValue& value : ladder.values)
        if (std::ranges::none_of(report.front,
                                 [&](std::size_t i) { return label_of(ladder.knob, report.trials[i].choice) == value.label; }))
            unused.push_back(value.label);
    return unused;
}

std::vector<Table> tables(const Report& report) {
    return {
        knob_table(report),
        trial_table(report, "Combinations",
                    "Downhill from the dearest settings, on a spread of tiles, each step the one that saves most for the error "
                    "it adds; measured again here. >: on the front",
                    report.walk),
        trial_table(report, "The front",
                    "No other settings tried are both faster and closer in RMSE. On no front here: " + unused_text(report),
                    report.front),
        ray_table(report)};
}

std::vector<std::string> preamble(const Report& report) {
    const std::string sample = std::to_string(report.width) + "x" + std::to_string(report.height) + ", " + sample_text(report) +
                               (report.whole ? "" : "; times are scaled to it");
    return {report.scene + ", " + sample,
            report.cpu + ", " + report.compiler + ", " + counted(static_cast<std::size_t>(report.threads), "thread") +
                "; processor time of all threads, median of " + std::to_string(report.repetitions) + " and half the range",
            "as given: " + describe(report.base, report.ladders),
            "reference: " + describe(report.truth, report.ladders) + ", in double; " + short_seconds(report.truth_seconds),
            "its own error: a second picture (" + report.second_choice + ") differs by RMSE " + short_error(report.second.rmse) +
                ", FLIP " + short_error(report.second.flip) + "; differences below that are not resolved"};
}

std::string text_report(const Report& report) {
    std::string text;
    for (const std::string& line : preamble(report)) text += line + "\n";
    for (const Table& table : tables(report)) {
        std::vector<std::size_t> widths;
        for (std::size_t c = 0; c < table.head.size(); ++c) {
            widths.push_back(table.head[c].size());
            for (const auto& row : table.rows) widths[c] = std::max(widths[c], row[c].size());
        }
        const auto add = [&](const std::vector<std::string>& row) {
            std::string line;
            for (std::size_t c = 0; c < row.size(); ++c)
                line += (c == 0 ? "" : "  ") + padded(row[c], widths[c], c < table.words);
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        };
        text += "\n" + table.title + "\n" + table.note + "\n";
        add(table.head);
        for (const auto& row : table.rows) add(row);
    }
    return text;
}

} // namespace lanecast::trade
