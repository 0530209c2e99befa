#include "scene/scratch.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lanecast {

void advise_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef MADV_HUGEPAGE
    // Only whole pages: the rest of the last one may belong to others. A kernel without them says no, which is no matter.
    if (const std::size_t whole = bytes / huge_page * huge_page; whole > 0) (void)madvise(memory, whole, MADV_HUGEPAGE);
#endif
}

} // namespace lanecast
