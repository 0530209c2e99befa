#pragma once
// Large uninitialised arrays that live while a scene is flattened.

#include "scene/huge_pages.hpp"

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace lanecast {

struct ScratchDelete {
    void operator()(void* memory) const noexcept { ::operator delete (memory, std::align_val_t{huge_page}); }
};
template <class T>
using Scratch = std::unique_ptr<T[], ScratchDelete>;

template <class T>
[[nodiscard]] Scratch<T> make_scratch(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new (bytes, std::align_val_t{huge_page});
    prefer_huge_pages(memory, bytes);
    return Scratch<T>(static_cast<T*>(memory));
}

} // namespace lanecast
