#include "cli/measure/report.hpp"

namespace lanecast::trade {
namespace {

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return safe;
}

std::string row_of(const std::vector<std::string>& cells, std::size_t words, const char* cell) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        html += std::string("<") + cell + (i < words ? " class=\"w\">" : ">") + escaped(cells[i]) + "</" + cell + ">";
    return html + "</tr>\n";
}

} // namespace

std::string html_report(const Report& report) {
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + escaped(report.scene) +
                       ": error and time</title>\n<style>body{font-family:sans-serif;margin:2em}table{border-collapse:collapse}"
                       "td,th{padding:2px 8px;text-align:right;font-variant-numeric:tabular-nums}.w{text-align:left}"
                       "tr:nth-child(even){background:#f4f4f4}</style>\n</head>\n<body>\n";
    for (const std::string& line : preamble(report)) html += "<p>" + escaped(line) + "</p>\n";
    html += svg_of(plot(report));
    for (const Table& table : tables(report)) {
        html += "<h2>" + escaped(table.title) + "</h2>\n<p>" + escaped(table.note) + "</p>\n<table>\n" +
                row_of(table.head, table.words, "th");
        for (const auto& row : table.rows) html += row_of(row, table.words, "td");
        html += "</table>\n";
    }
    return html + "</body>\n</html>\n";
}

} // namespace lanecast::trade
