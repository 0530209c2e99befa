#include "cli/selftest/report.hpp"

#include "cli/print.hpp"

namespace lanecast::selftest {
namespace {

std::string left(const std::string& text, std::size_t width) {
    return text.size() < width ? text + std::string(width - text.size(), ' ') : text + " ";
}
std::string right(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : " " + text;
}

std::string three_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

const char* verdict(const Progress& p) {
    if (!p.is_done()) return "broken off";
    if (is_met(p.c->target, p.tally)) return "met";
    return p.c->target.listed ? "listed" : "MISSED";
}

} // namespace

std::string table_header() {
    return left("case", 30) + right("rays", 10) + right("failures", 10) + right("worst", 10) + right("p99", 10) +
           right("mean", 10) + right("time", 10) + "  " + left("target", 34) + "\n";
}

std::string table_row(const Progress& p) {
    const bool errors = !p.tally.errors.empty();
    std::string row = left(name_of(*p.c), 30) + right(short_count(static_cast<double>(p.tally.rays)), 10) +
                      right(std::to_string(p.tally.failures), 10) + right(errors ? three_digits(p.tally.worst) : "-", 10) +
                      right(errors ? three_digits(p.tally.percentile(0.99)) : "-", 10) +
                      right(errors ? three_digits(p.tally.mean()) : "-", 10) + right(short_seconds(p.seconds), 10) + "  " +
                      left(text_of(p.c->target), 34) + verdict(p) + "\n";
    if (p.tally.failures > 0) row += "    " + p.tally.example + "\n";
    return row;
}

void add_cases(JsonWriter& json, const std::vector<Progress>& all) {
    json.open_list("cases");
    for (const Progress& p : all) {
        json.open_object();
        json.add("id", p.c->id);
        json.add("part", p.c->part);
        json.add("statement", p.c->statement);
        json.add("rays", p.tally.rays);
        json.add("failures", p.tally.failures);
        if (!p.tally.errors.empty()) {
            json.add("worst", p.tally.worst);
            json.add("p50", p.tally.percentile(0.5));
            json.add("p99", p.tally.percentile(0.99));
            json.add("mean", p.tally.mean());
            json.add("unit", p.c->target.unit);
        }
        json.add("target", text_of(p.c->target));
        json.add("verdict", verdict(p));
        json.add("seconds", p.seconds);
        if (p.tally.failures > 0) json.add("example", p.tally.example);
        json.close_object();
    }
    json.close_list();
}

std::string json_report(const std::string& run, const std::vector<Progress>& all) {
    JsonWriter json;
    json.open_object();
    json.add("run", run);
    add_cases(json, all);
    json.close_object();
    return json.finished();
}

} // namespace lanecast::selftest
