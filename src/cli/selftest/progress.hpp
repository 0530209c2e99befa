#pragma once
// How far a case has come: what is kept between two runs.

#include "cli/selftest/case.hpp"

#include <string>
#include <vector>

namespace lanecast::selftest {

struct Progress {
    const Case* c = nullptr;
    std::uint64_t blocks = 0; ///< the first so many are in the tally
    std::uint64_t planned = 0;
    Tally tally;
    double seconds = 0; ///< of wall-clock time
    [[nodiscard]] bool is_done() const { return blocks >= planned; }
};

[[nodiscard]] std::string name_of(const Case& c); ///< "N1 edges"

} // namespace lanecast::selftest
