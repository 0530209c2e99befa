#pragma once
// Rays against infinite planes, normal . p = distance.

#include "scene/scene_view.hpp"
#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// In units of |d|; infinite or NaN, which no range accepts (`no_limit`), for rays that run along the plane.
template <FloatBatch F>
LANECAST_INLINE F plane_t(const PlaneRecord& plane, const Vec3<F>& org, const Vec3<F>& dir) {
    using S = Scalar<F>;
    const Vec3<F> n = splat<F>(plane.normal);
    // off by 3 u (|org| + |distance|), which is no more than the origin is already
    const F height = (n.x * org.x + n.y * org.y) + (n.z * org.z - F(S(plane.distance)));
    return -height / dot(n, dir);
}

} // namespace lanecast::inline LANECAST_ISA
