#pragma once
// What was measured, and how it is shown.

#include "cli/bench/agreement.hpp"
#include "cli/bench/drawing.hpp"
#include "cli/bench/measure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace lanecast::bench {

/// One contender on one set.
struct Row {
    std::string rays, library, isa, precision, mode;
    bool ours = false;
    int threads = 1;
    std::size_t count = 0;
    Rate rate;
    Disagreements reference; ///< with the double-precision reference
    Disagreements peer;      ///< ours, with the best peer
};

struct Report {
    std::string mesh, cpu, compiler, commit, options;
    std::size_t triangles = 0;
    int repetitions = 0;
    std::vector<BuildRow> builds;
    std::vector<Row> rows;
};

/// The best of the others on the same rays, at the same instruction set and number of threads; null: there are none.
[[nodiscard]] const Row* best_peer(const Report& report, const Row& row);

[[nodiscard]] std::string text_report(const Report& report);
[[nodiscard]] std::string json_report(const Report& report);
/// Ratios to the best peer as bars, or rates where there is none; a group per kind of rays, a colour per instruction set.
[[nodiscard]] Drawing plot(const Report& report);

} // namespace lanecast::bench
