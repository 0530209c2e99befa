#pragma once
// What a ray of the seed tracer meets.

#include "golden/seed_scene.hpp"

namespace lanecast::test {

template <class Real>
struct SeedRay {
    Vec<Real> org, dir;  ///< dir of any length; t is in units of it
    Real tmin = 0;       ///< a hit has t > tmin
    int source = -1;     ///< the body it leaves from, unless faults.absolute_tmin: flat ones and the near side are not met
    bool inward = false; ///< whether it goes into that body
};

template <class Real>
struct SeedHit {
    Real t = std::numeric_limits<Real>::infinity();
    int body = -1; ///< -1: nothing
    Vec<Real> point{0};
    Vec<Real> normal{0}; ///< outward; unit but for the faults
};

/// Instantiated for float and double.
template <class Real>
[[nodiscard]] SeedHit<Real> closest_hit(const SeedScene<Real>& scene, const SeedFaults& faults, const SeedRay<Real>& ray);

} // namespace lanecast::test
