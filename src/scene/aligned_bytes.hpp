#pragma once
// Uninitialised memory on a cache line's boundary: the tree's arena, and the scratch blocks of kernels.

#include "scene/huge_pages.hpp"

#include <cstddef>
#include <memory>
#include <new>

namespace lanecast {

inline constexpr std::align_val_t cache_line{64};

struct AlignedDelete {
    std::align_val_t alignment = cache_line;
    void operator()(unsigned char* bytes) const noexcept { ::operator delete[](bytes, alignment); }
};
using AlignedBytes = std::unique_ptr<unsigned char[], AlignedDelete>;

/// Throws std::bad_alloc.
[[nodiscard]] inline AlignedBytes make_aligned_bytes(std::size_t count) {
    return AlignedBytes(static_cast<unsigned char*>(::operator new[](count, cache_line)), {cache_line});
}

/// The same for what all of is read at random: whole huge pages from one on.
[[nodiscard]] inline AlignedBytes make_paged_bytes(std::size_t count) {
    if (count < huge_page) return make_aligned_bytes(count);
    constexpr std::align_val_t page{huge_page};
    const std::size_t pages = (count + huge_page - 1) / huge_page * huge_page;
    auto* const bytes = static_cast<unsigned char*>(::operator new[](pages, page));
    prefer_huge_pages(bytes, pages);
    return AlignedBytes(bytes, {page});
}

} // namespace lanecast
