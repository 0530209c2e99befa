#pragma once
// What asks Embree is in a module beside the program, which is there where CMake found Embree.

namespace lanecast {

/// Null where the module is not there, or cannot be loaded.
[[nodiscard]] void* find_in_embree_module(const char* name);

template <class Function>
[[nodiscard]] Function* find_in_embree_module(const char* name) {
    return reinterpret_cast<Function*>(find_in_embree_module(name));
}

} // namespace lanecast
