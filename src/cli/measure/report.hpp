#pragma once
// What was measured, shown.

#include "cli/bench/drawing.hpp"
#include "cli/measure/experiment.hpp"

#include <string>

namespace lanecast::trade {

[[nodiscard]] std::string text_report(const Report& report);
[[nodiscard]] std::string json_report(const Report& report);
/// Error against time, both logarithmic, a colour per knob, the front as a line.
[[nodiscard]] bench::Drawing plot(const Report& report);
/// The plot and the tables in one file that needs no other.
[[nodiscard]] std::string html_report(const Report& report);

/// Whether no other trial is both faster and closer.
[[nodiscard]] bool is_on_front(const Report& report, std::size_t trial);

/// Values of a knob that no settings on the front have: of all scenes together, what could be deleted.
[[nodiscard]] std::vector<std::string> unused_values(const Report& report, const Ladder& ladder);

/// A table as all reports show it. Cells are text; numbers stand on the right.
struct Table {
    std::string title, note;
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
    std::size_t words = 0; ///< columns that stand on the left
};
[[nodiscard]] std::vector<Table> tables(const Report& report);
/// Scene, machine, sample and reference, a line each.
[[nodiscard]] std::vector<std::string> preamble(const Report& report);

} // namespace lanecast::trade
