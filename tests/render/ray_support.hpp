#pragma once
// Batches of rays in memory, traced through a KernelTable.

#include "cli/selftest/rays.hpp"
#include "render/dispatch.hpp"
#include "scene/geometry_support.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace lanecast::test {

#ifdef LANECAST_SANITIZED
inline constexpr int fewer = 20;
#else
inline constexpr int fewer = 1;
#endif
/// The number of random cases to run: `n` in plain builds, a twentieth in sanitized ones.
constexpr int cases(int n) { return n / fewer > 0 ? n / fewer : 1; }

/// The balanced kernels that this build holds and this CPU runs, scalar first.
inline std::vector<const KernelTable*> balanced_kernels() { return usable_kernels(Precision::balanced); }
/// The fast ones, slowest first; none in a build without them.
inline std::vector<const KernelTable*> fast_kernels() { return usable_kernels(Precision::fast); }
inline const KernelTable& scalar_kernels() { return find_kernels("scalar", Precision::balanced); }
inline const KernelTable& reference_kernels() { return find_kernels("auto", Precision::reference); }

using selftest::bits_of, selftest::Hits, selftest::Query, selftest::Rays;

inline Hits ask(const KernelTable& kernels, const SceneView& scene, const Rays& rays, Query what, bool brute_force = false) {
    return selftest::ask(kernels, scene, rays, selftest::Path::batch, what, brute_force);
}

} // namespace lanecast::test
