#pragma once
// Which combinations of kernels, primitives, placings, leaf sizes and paths a case runs: few, but any two values meet in one.

#include "cli/selftest/case.hpp"

namespace lanecast::selftest {

/// Rows such that each pair of values of two factors that make a difference to the case stands in at least one. The same rows
/// every time.
[[nodiscard]] std::vector<Setting> covering_settings(const Case& c, const std::vector<const KernelTable*>& kernels);

/// Rays of a block: scalar kernels get a 32nd, calls with one ray each an eighth.
[[nodiscard]] std::uint64_t block_rays(const Setting& setting, std::uint64_t usual);

/// Blocks of a case that sends about `rays` rays, row after row of its settings: at least one of each.
struct Plan {
    std::vector<Setting> settings;
    std::uint64_t usual_rays; ///< of a block
    std::uint64_t blocks;
};
[[nodiscard]] Plan make_plan(const Case& c, const std::vector<const KernelTable*>& kernels, std::uint64_t rays);

} // namespace lanecast::selftest
