#pragma once
// Batches of rays in memory, traced through a KernelTable.

#include "render/dispatch.hpp"
#include "scene/geometry_support.hpp"

#include <bit>
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

struct Rays {
    std::vector<float> org[3], dir[3], tmin, tmax;
    [[nodiscard]] std::size_t size() const { return tmin.size(); }
    void add(const glm::dvec3& o, const glm::dvec3& d, float lo = 0, float hi = std::numeric_limits<float>::infinity()) {
        for (int axis = 0; axis < 3; ++axis) {
            org[axis].push_back(static_cast<float>(o[axis]));
            dir[axis].push_back(static_cast<float>(d[axis]));
        }
        tmin.push_back(lo);
        tmax.push_back(hi);
    }
};

struct Hits {
    std::vector<float> t;
    std::vector<std::int32_t> slot;
};

enum class Ask { closest, any };

inline Hits ask(const KernelTable& kernels, const SceneView& scene, const Rays& rays, Ask what, bool brute_force = false) {
    Hits hits{std::vector<float>(rays.size(), -7.0f), std::vector<std::int32_t>(rays.size(), -7)};
    RayStream stream{};
    for (int axis = 0; axis < 3; ++axis) stream.org[axis] = rays.org[axis].data(), stream.dir[axis] = rays.dir[axis].data();
    stream.tmin = rays.tmin.data();
    stream.tmax = rays.tmax.data();
    stream.t = hits.t.data();
    stream.slot = hits.slot.data();
    stream.brute_force = brute_force ? 1 : 0;
    stream.count = static_cast<std::uint32_t>(rays.size());
    (what == Ask::closest ? kernels.closest_hit : kernels.any_hit)(scene, stream);
    return hits;
}

inline std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

} // namespace lanecast::test
