#pragma once
// The table of a run, and the same as JSON.

#include "cli/json_writer.hpp"
#include "cli/selftest/progress.hpp"

#include <string>
#include <vector>

namespace lanecast::selftest {

[[nodiscard]] std::string table_header();
/// A line per case; a second one with the first failure where there is one.
[[nodiscard]] std::string table_row(const Progress& progress);
/// As the list "cases" of the object that is open.
void add_cases(JsonWriter& json, const std::vector<Progress>& all);
[[nodiscard]] std::string json_report(const std::string& run, const std::vector<Progress>& all);

} // namespace lanecast::selftest
