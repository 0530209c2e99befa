#include "cli/embree_module.hpp"

#include <filesystem>

#include <dlfcn.h>

namespace lanecast {

void* find_in_embree_module(const char* name) {
    std::error_code fault;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", fault);
    if (fault) return nullptr;
    void* const module = ::dlopen((program.parent_path() / "lanecast_embree.so").c_str(), RTLD_NOW | RTLD_LOCAL); // stays loaded
    return module == nullptr ? nullptr : ::dlsym(module, name);
}

} // namespace lanecast
