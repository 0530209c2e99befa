#include "cli/selftest/progress.hpp"

namespace lanecast::selftest {

std::string name_of(const Case& c) { return std::string(c.id) + (*c.part ? " " : "") + c.part; }

} // namespace lanecast::selftest
