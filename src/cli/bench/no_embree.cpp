// Stands in for embree.cpp where Embree was not found.

#include "cli/bench/contender.hpp"

namespace lanecast::bench {

std::string embree_version() { return {}; }
void add_embree(Contenders&, std::vector<BuildRow>&, const BenchMesh&, const std::string&, int) {}

} // namespace lanecast::bench
