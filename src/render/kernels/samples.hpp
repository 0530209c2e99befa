#pragma once
// Samples of pixels: camera rays in batches, traced and added up.

#include "render/kernels/camera.hpp"
#include "render/kernels/pixels.hpp"
#include "render/kernels/whitted.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
struct TileScratch {
    Wavefront<F> wavefront;
    RayQueue<F> camera;
    PixelBatch<F> pixels;

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        wavefront.allocate(layout, job);
        camera.allocate(layout, job);
        pixels.allocate(layout, job);
    }
};

/// A hash of the pixel and its sample, for the rotation of soft shadows.
LANECAST_INLINE std::int32_t pixel_seed(std::int32_t x, std::int32_t y, std::uint32_t sample) {
    std::uint32_t h =
        static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca6bu ^ sample * 0xc2b2ae35u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return static_cast<std::int32_t>(h ^ (h >> 15));
}

/// The samples of a pass.
struct SamplePattern {
    std::uint32_t samples;
    std::uint32_t side; ///< of the grid; 0: the four arms of the cross
    float offset;
    RayKind kind;
    std::uint32_t first_seed = 0; ///< of the soft shadows of sample 0; the centre ray has 0

    /// Of sample s, in pixels from the pixel's corner.
    template <class S>
    LANECAST_INLINE void at(std::uint32_t s, S& x, S& y) const {
        if (side == 0) { // up, down, left, right
            x = S(0.5) + (s == 2 ? -static_cast<S>(offset) : s == 3 ? static_cast<S>(offset) : S(0));
            y = S(0.5) + (s == 0 ? -static_cast<S>(offset) : s == 1 ? static_cast<S>(offset) : S(0));
        } else {
            x = (static_cast<S>(s % side) + S(0.5)) / static_cast<S>(side);
            y = (static_cast<S>(s / side) + S(0.5)) / static_cast<S>(side);
        }
    }
};

/// Camera rays through the image points that stand in rays.dir[0] and rays.dir[1].
template <FloatBatch F>
void camera_rays(const RenderJob& job, RayQueue<F>& queue) {
    const Vec3<F> org = splat<F>(job.camera.org);
    for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
        const Vec3<F> dir = camera_direction<F>(job.camera, load<F>(queue.rays.dir[0] + i), load<F>(queue.rays.dir[1] + i));
        store<F>(queue.rays.org, i, org);
        store<F>(queue.rays.dir, i, dir);
        store(queue.rays.source + i, Int<F>(no_source));
        if (queue.weight != nullptr) store(queue.weight + i, F(1));
        if (queue.record != nullptr) store(queue.record + i, Int<F>(-1));
    }
    queue.rays.tmin = static_cast<Scalar<F>>(job.camera.near);
}

/// Normals of the batch's surfaces: the integrator's own are gone when it returns.
template <FloatBatch F>
void keep_normals(const SceneView& scene, const RayQueue<F>& queue, Scalar<F>* const (&normal)[3], std::uint32_t first) {
    for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
        const Int<F> slot = load_int<F>(queue.rays.slot + i);
        const Mask<F> found = (slot > Int<F>(-1)) & first_lanes<F>(queue.count - i);
        if (none(found)) continue;
        const Surface<F> s =
            surface_at<F>(scene, load<F>(queue.rays.org, i), load<F>(queue.rays.dir, i), load<F>(queue.rays.t + i), slot, found);
        store<F>(normal, first + i, s.normal);
    }
}

/// One ray through the centre of every pixel.
template <FloatBatch F>
void trace_centres(TileScratch<F>& scratch) {
    using S = Scalar<F>;
    const RenderJob& job = *scratch.wavefront.job;
    PixelBatch<F>& pixels = scratch.pixels;
    RayQueue<F>& queue = scratch.camera;
    for (std::uint32_t begin = 0; begin < pixels.count; begin += batch_rays) {
        queue.count = pixels.count - begin < batch_rays ? pixels.count - begin : batch_rays;
        for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
            store(queue.rays.dir[0] + i, load<F>(pixels.corner[0] + begin + i) + F(S(0.5)));
            store(queue.rays.dir[1] + i, load<F>(pixels.corner[1] + begin + i) + F(S(0.5)));
        }
        if (queue.seed != nullptr)
            for (std::uint32_t i = 0; i < queue.count; ++i)
                queue.seed[i] = pixel_seed(pixels.x[begin + i], pixels.y[begin + i], 0);
        camera_rays(job, queue);
        trace_queue(scratch.wavefront, queue, RayKind::primary, 0);
        for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
            store<F>(pixels.sum, begin + i, load<F>(queue.color, i));
            store(pixels.slot + begin + i, load_int<F>(queue.rays.slot + i));
        }
        if (job.anti_alias == AntiAliasKind::edge) keep_normals<F>(job.scene, queue, pixels.normal, begin);
    }
}

/// All samples of the chosen pixels, a pixel's samples side by side, added up in order.
template <FloatBatch F>
void trace_samples(TileScratch<F>& scratch, const SamplePattern& pattern, Scalar<F>* const (&sum)[3]) {
    using S = Scalar<F>;
    const RenderJob& job = *scratch.wavefront.job;
    const PixelBatch<F>& pixels = scratch.pixels;
    RayQueue<F>& queue = scratch.camera;
    // the ray that comes next when queueing, and when adding up
    std::uint32_t pixel = 0, sample = 0, summed_pixel = 0, summed_sample = 0;
    const auto step = [&](std::uint32_t& p, std::uint32_t& s) {
        if (++s == pattern.samples) {
            s = 0;
            ++p;
        }
    };
    while (pixel < pixels.chosen_count) {
        std::uint32_t n = 0;
        for (; n < batch_rays && pixel < pixels.chosen_count; ++n, step(pixel, sample)) {
            const std::uint32_t at = pixels.chosen[pixel];
            S x, y;
            pattern.at(sample, x, y);
            queue.rays.dir[0][n] = pixels.corner[0][at] + x;
            queue.rays.dir[1][n] = pixels.corner[1][at] + y;
            if (queue.seed != nullptr) queue.seed[n] = pixel_seed(pixels.x[at], pixels.y[at], sample + pattern.first_seed);
        }
        queue.count = n;
        camera_rays(job, queue);
        trace_queue(scratch.wavefront, queue, pattern.kind, 0);
        for (std::uint32_t i = 0; i < n; ++i, step(summed_pixel, summed_sample)) {
            const std::uint32_t at = pixels.chosen[summed_pixel];
            for (int c = 0; c < 3; ++c) sum[c][at] += queue.color[c][i];
        }
    }
}

} // namespace lanecast::inline LANECAST_ISA
