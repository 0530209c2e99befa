#pragma once
// Boxes in, eight-wide tree in one arena out. The steps: bvh_binary, bvh_collapse, emission.

#include "scene/aligned_bytes.hpp"
#include "scene/bvh_binary.hpp"
#include "scene/scene_arrays.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lanecast {

inline constexpr std::uint32_t first_here = 0x80000000u;

struct BvhTree {
    AlignedBytes arena; ///< nodes are written, triangle blocks are left to the caller
    std::size_t arena_bytes = 0;
    std::vector<std::uint64_t> leaves;         ///< child words, in arena order
    std::vector<std::uint32_t> leaf_first_ref; ///< per leaf: its primitives are the `refs` from here on
    std::vector<std::uint32_t> shared_slots;   ///< with first_here where the triangle has its slot from here
    float max_coordinate = 0;
};

/// Reorders `refs`. first_slot[kind]: slot of the kind's first primitive. The same bytes for any number of threads. Without
/// primitives, an empty tree. Throws Error (memory) where the arena exceeds 2 GiB.
[[nodiscard]] BvhTree build_bvh(BuildRef* refs, std::size_t count, const std::uint32_t* first_slot, const SpatialRoom* spatial,
                                int threads);

} // namespace lanecast
