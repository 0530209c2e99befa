#pragma once
// What contenders made of the same rays, side by side.

#include "cli/selftest/peer.hpp"
#include "cli/selftest/progress.hpp"

namespace lanecast::selftest {

/// The head of a Markdown table, with a line before it that says what stands in a cell.
[[nodiscard]] std::string comparison_header(const std::vector<Contender>& contenders);
/// One case, as each contender did.
[[nodiscard]] std::string comparison_row(const std::vector<Progress>& results);
/// By contender the results of its cases.
[[nodiscard]] std::string comparison_json(const std::string& run, const std::vector<Contender>& contenders,
                                          const std::vector<std::vector<Progress>>& results);

} // namespace lanecast::selftest
