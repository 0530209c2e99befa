#pragma once
// Rays of the scene, one by one: the same rays, origins and directions in float, through a preset's kernels and through the
// reference. Pictures of mirrors of mirrors may diverge; a single intersection says whether the arithmetic is right.

#include "cli/measure/trial.hpp"

#include <array>
#include <string>
#include <vector>

namespace lanecast::trade {

enum class RayClass { camera, shadow, reflection, refraction };
inline constexpr int ray_class_count = 4;
[[nodiscard]] const char* name_of(RayClass rays);

/// In normalised units.
struct RayList {
    std::array<std::vector<float>, 3> org, dir;
    std::vector<float> tmax;
    [[nodiscard]] std::size_t size() const { return tmax.size(); }
};
using RayLists = std::array<RayList, ray_class_count>;

/// Camera rays through the sample's pixels, about `count` of them; and those that come of a share of them as `balanced` traces
/// them: shadow rays to the middle of each light, mirrored and transmitted ones.
[[nodiscard]] RayLists collect_rays(const Bench& bench, const RenderSettings& settings, std::size_t count);

struct RayErrors {
    std::string precision, isa;
    RayClass rays = RayClass::camera;
    std::size_t count = 0;
    std::size_t missed = 0, false_hits = 0;             ///< the reference hits, and misses
    std::size_t wrong_object = 0;                       ///< another primitive, and t differs by more than 4 ulp: not a tie
    std::size_t compared = 0;                           ///< the same primitive; not of shadow rays, which ask for any
    double ulp_p50 = 0, ulp_p99 = 0, ulp_max = 0;       ///< of t, from the float nearest to the reference's
    double angle_p50 = 0, angle_p99 = 0, angle_max = 0; ///< between the normals, radians
};

/// One per class that has rays. `precision`: what the kernels are called.
[[nodiscard]] std::vector<RayErrors> ray_errors(const Bench& bench, const RayLists& rays, const KernelTable& kernels,
                                                const std::string& precision);

} // namespace lanecast::trade
