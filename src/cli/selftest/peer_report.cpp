#include "cli/selftest/peer_report.hpp"

#include "cli/print.hpp"
#include "cli/selftest/report.hpp"

namespace lanecast::selftest {
namespace {

std::string two_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

std::string cell(const Tally& tally) {
    if (tally.rays == 0) return "-";
    std::string text = two_digits(static_cast<double>(tally.failures) / static_cast<double>(tally.rays));
    if (!tally.errors.empty()) text += "; " + two_digits(tally.percentile(0.99)) + ", " + two_digits(tally.worst);
    return text;
}

/// Of a unit such as |T|, in a cell.
std::string escaped(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
    return text;
}

} // namespace

std::string comparison_header(const std::vector<Contender>& contenders) {
    std::string text =
        "Share of rays that fail; then p99 and worst of the errors. Listed, not judged.\n\n| case | rays | asked of us |";
    for (const Contender& contender : contenders) text += " " + contender.name + " |";
    text += "\n|---|---|---|";
    for (std::size_t i = 0; i < contenders.size(); ++i) text += "---|";
    return text + "\n";
}

std::string comparison_row(const std::vector<Progress>& results) {
    const Progress& first = results.front();
    std::string text = "| " + name_of(*first.c) + " | " + short_count(static_cast<double>(first.tally.rays)) + " | " +
                       escaped(text_of(first.c->target)) + " |";
    for (const Progress& result : results) text += " " + cell(result.tally) + " |";
    return text + "\n";
}

std::string comparison_json(const std::string& run, const std::vector<Contender>& contenders,
                            const std::vector<std::vector<Progress>>& results) {
    JsonWriter json;
    json.open_object();
    json.add("run", run);
    json.open_list("contenders");
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        json.open_object();
        json.add("name", contenders[i].name);
        std::vector<Progress> own;
        for (const std::vector<Progress>& row : results) own.push_back(row[i]);
        add_cases(json, own);
        json.close_object();
    }
    json.close_list();
    json.close_object();
    return json.finished();
}

} // namespace lanecast::selftest
