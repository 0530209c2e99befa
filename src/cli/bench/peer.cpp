// What asks Embree comes from a module beside the program, which is there where CMake found Embree.

#include "cli/bench/builds.hpp"
#include "cli/bench/contender.hpp"
#include "cli/embree_module.hpp"

namespace lanecast::bench {

void add_embree(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
                int threads) {
    static auto* const add = find_in_embree_module<decltype(add_embree)>("lanecast_add_embree");
    if (add != nullptr) add(contenders, builds, mesh, isa, threads);
}

bool time_embree_build(const BenchMesh& mesh, const std::string& isa, bool high, int threads, BuildTime& time) {
    static auto* const build = find_in_embree_module<decltype(time_embree_build)>("lanecast_time_embree_build");
    return build != nullptr && build(mesh, isa, high, threads, time);
}

} // namespace lanecast::bench
