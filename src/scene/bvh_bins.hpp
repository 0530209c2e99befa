#pragma once
// Binned surface area heuristic (Wald 2007): where to cut a large range.

#include "scene/bvh_refs.hpp"

namespace lanecast {

inline constexpr int max_bins = 32;

/// Bin of a centre (lo + hi) on each axis. The same operations when counting and when partitioning, so both agree.
struct BinMapping {
    Float4 origin{};
    Float4 scale{}; ///< 0 on an axis without extent, which then has one bin
    int bins = 0;

    [[nodiscard]] Int4 operator()(Float4 centre) const noexcept {
        return __builtin_convertvector((centre - origin) * scale, Int4);
    }
};

[[nodiscard]] BinMapping make_bin_mapping(const BuildRange& range);

struct BinCut {
    int axis = -1; ///< -1: every centre falls into one bin
    int bin = 0;   ///< first bin of the right half
    std::uint32_t left_count = 0;
    float cost = 0;      ///< area times count, summed over both halves
    Float4 lo[2], hi[2]; ///< boxes of the halves
};

[[nodiscard]] BinCut find_bin_cut(const BuildRef* refs, const BuildRange& range, const BinMapping& mapping, int threads);

} // namespace lanecast
