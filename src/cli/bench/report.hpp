#pragma once
// What was measured, and how it is shown.

#include "cli/bench/measure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace lanecast::bench {

/// Differences from another's hits: beyond 1e-3 of t.
struct Disagreements {
    std::size_t checked = 0;
    std::size_t missed = 0, extra = 0, other_t = 0;
    std::size_t ties = 0;  ///< the same t, another triangle; no disagreement
    std::size_t edges = 0; ///< of all disagreements: the truth itself changes so within rounding of the ray
    [[nodiscard]] std::size_t count() const { return missed + extra + other_t; }
};

/// One contender on one set.
struct Row {
    std::string rays, library, isa, precision, mode;
    bool ours = false;
    int threads = 1;
    std::size_t count = 0;
    Rate rate;
    Disagreements reference; ///< against the double-precision reference
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

} // namespace lanecast::bench
