// Embree's contenders come from a module beside the program, which is there where CMake found Embree.

#include "cli/bench/contender.hpp"

#include <filesystem>

#include <dlfcn.h>

namespace lanecast::bench {
namespace {

using AddEmbree = void (*)(Contenders&, std::vector<BuildRow>&, const BenchMesh&, const std::string&, int);

AddEmbree find_module() {
    std::error_code fault;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", fault);
    if (fault) return nullptr;
    void* const module = ::dlopen((program.parent_path() / "lanecast_embree.so").c_str(), RTLD_NOW | RTLD_LOCAL); // stays loaded
    return module == nullptr ? nullptr : reinterpret_cast<AddEmbree>(::dlsym(module, "lanecast_add_embree"));
}

} // namespace

void add_embree(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
                int threads) {
    static const AddEmbree add = find_module();
    if (add != nullptr) add(contenders, builds, mesh, isa, threads);
}

} // namespace lanecast::bench
