#pragma once
// Uninitialised memory on a cache line's boundary: the tree's arena, and the scratch blocks of kernels.

#include <cstddef>
#include <memory>
#include <new>

namespace lanecast {

inline constexpr std::align_val_t cache_line{64};

struct AlignedDelete {
    void operator()(unsigned char* bytes) const noexcept { ::operator delete[](bytes, cache_line); }
};
using AlignedBytes = std::unique_ptr<unsigned char[], AlignedDelete>;

/// Throws std::bad_alloc.
[[nodiscard]] inline AlignedBytes make_aligned_bytes(std::size_t count) {
    return AlignedBytes(static_cast<unsigned char*>(::operator new[](count, cache_line)));
}

} // namespace lanecast
