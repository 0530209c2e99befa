#pragma once
// Rays in memory, and what a table of kernels says of them: the same doors that the renderer and the library use.

#include "cli/selftest/case.hpp"
#include "scene/scene_arrays.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast::selftest {

/// Normalised; components are rounded to float.
struct Rays {
    std::vector<float> org[3], dir[3], tmin, tmax; ///< tmin and tmax may be empty: 0 and infinity
    [[nodiscard]] std::size_t size() const { return org[0].size(); }
    void add(const glm::dvec3& o, const glm::dvec3& d) {
        for (int axis = 0; axis < 3; ++axis) {
            org[axis].push_back(static_cast<float>(o[axis]));
            dir[axis].push_back(static_cast<float>(d[axis]));
        }
    }
    void add_range(float lo, float hi) {
        tmin.push_back(lo);
        tmax.push_back(hi);
    }
    [[nodiscard]] glm::dvec3 o(std::size_t i) const { return {org[0][i], org[1][i], org[2][i]}; }
    [[nodiscard]] glm::dvec3 d(std::size_t i) const { return {dir[0][i], dir[1][i], dir[2][i]}; }
};

struct Hits {
    std::vector<float> t; ///< tmax of a miss, infinity where there is none
    std::vector<std::int32_t> slot;
};

enum class Query { closest, any };

/// All rays, as `path` has it: in one call or one call each. Brute force: every primitive instead of the tree.
[[nodiscard]] Hits ask(const KernelTable& kernels, const SceneView& scene, const Rays& rays, Path path,
                       Query query = Query::closest, bool brute_force = false);

/// Hits in the caller's units, with normals.
struct WorldHits {
    std::vector<float> t, normal[3];
    std::vector<std::int32_t> slot;
};

/// The closest hits of rays that are in the caller's units, too, and have no ranges.
[[nodiscard]] WorldHits ask_in_world(const KernelTable& kernels, const SceneArrays& scene, const Rays& rays, Path path);

/// Exchanges rays at random, their ranges with them; returns where each came from.
std::vector<std::uint32_t> shuffle(Rays& rays, std::uint64_t seed);

[[nodiscard]] inline std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

/// Distance of `value` from `exact` in units of the last place that a float near `exact` has.
[[nodiscard]] double ulps(float value, double exact);

} // namespace lanecast::selftest
