#pragma once
// The whole ray tree of one pixel, written down by the kernels that render it.

#include "render/renderer.hpp"

#include <array>
#include <vector>

namespace lanecast {

struct PixelTrace {
    std::vector<TraceRecord> rays;  ///< parents before their children; the camera ray first
    std::vector<TraceLight> lights; ///< for each ray, in file order, the lights its surface faces
    std::array<float, 3> color{};   ///< of the film
};

/// The pixel (x, y) of the image, by its centre ray: settings.anti_aliasing is taken as off, options.crop does not count.
/// Throws Error (memory) for a tree of more than 2^22 rays, or of lights over all its rays.
[[nodiscard]] PixelTrace trace_pixel(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera,
                                     const RenderSettings& settings, const FrameOptions& options, int x, int y);

} // namespace lanecast
