#pragma once
// Local light of the seed tracer.

#include "golden/seed_intersect.hpp"

namespace lanecast::test {

template <class Real>
struct SeedSurface {
    Vec<Real> point, view; ///< view: unit, back along the ray
    Vec<Real> normal;      ///< outward; unit but for the faults
    bool inside = false;   ///< the ray came from where the normal does not point
    int body = -1;
};

/// The ray from a surface into `dir`, which leaves the body or goes into it.
template <class Real>
[[nodiscard]] SeedRay<Real> spawn(const SeedFaults& faults, const SeedSurface<Real>& surface, const Vec<Real>& dir);

/// Ambient light and all others. Instantiated for float and double.
template <class Real>
[[nodiscard]] Vec<Real> local_light(const SceneDescription& description, const SeedScene<Real>& scene, const SeedFaults& faults,
                                    const SeedSurface<Real>& surface);

} // namespace lanecast::test
