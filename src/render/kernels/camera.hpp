#pragma once
// Camera rays. A packet's footprint is a Morton block of pixels: 2x2 for 4 rays, 4x2 for 8, 4x4 for 16.

#include "render/kernel_table.hpp"
#include "simd/vec3.hpp"

namespace lanecast::inline LANECAST_ISA {

/// Through the image point (x, y), in pixels, y down. The small terms are summed first: one rounding against `forward`.
template <FloatBatch F>
LANECAST_INLINE Vec3<F> camera_direction(const CameraRecord& camera, F x, F y) {
    using S = Scalar<F>;
    const F sx = (x - F(S(camera.half_width))) * F(S(camera.pixel));
    const F sy = (F(S(camera.half_height)) - y) * F(S(camera.pixel));
    return splat<F>(camera.forward) + (splat<F>(camera.right) * sx + splat<F>(camera.up) * sy);
}

} // namespace lanecast::inline LANECAST_ISA
