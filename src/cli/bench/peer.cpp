// What asks Embree comes from a module beside the program, which is there where CMake found Embree.

#include "cli/bench/builds.hpp"
#include "cli/bench/contender.hpp"

#include <filesystem>

#include <dlfcn.h>

namespace lanecast::bench {
namespace {

/// Null where the module is not there.
template <class Function>
Function* find_in_module(const char* name) {
    std::error_code fault;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", fault);
    if (fault) return nullptr;
    void* const module = ::dlopen((program.parent_path() / "lanecast_embree.so").c_str(), RTLD_NOW | RTLD_LOCAL); // stays loaded
    return module == nullptr ? nullptr : reinterpret_cast<Function*>(::dlsym(module, name));
}

} // namespace

void add_embree(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
                int threads) {
    static auto* const add = find_in_module<decltype(add_embree)>("lanecast_add_embree");
    if (add != nullptr) add(contenders, builds, mesh, isa, threads);
}

bool time_embree_build(const BenchMesh& mesh, const std::string& isa, bool high, int threads, BuildTime& time) {
    static auto* const build = find_in_module<decltype(time_embree_build)>("lanecast_time_embree_build");
    return build != nullptr && build(mesh, isa, high, threads, time);
}

} // namespace lanecast::bench
