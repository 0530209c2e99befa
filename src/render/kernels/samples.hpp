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

/// Which samples of a pixel a pass takes: the four arms of a cross, a grid of side x side, the four of it nearest the pixel's
/// corners, or the others.
enum class SampleSet { cross, grid, corners, rest };

struct SamplePattern {
    SampleSet set;
    std::uint32_t side; ///< of the grid
    float offset;       ///< of the cross, in pixels
    RayKind kind;

    LANECAST_INLINE std::uint32_t count() const {
        return set == SampleSet::grid ? side * side : set == SampleSet::rest ? side * side - 4 : 4;
    }

    /// Number of sample s: of a grid row by row, whatever part of it is taken; of the cross from 1, for the centre is 0.
    LANECAST_INLINE std::uint32_t number(std::uint32_t s) const {
        const std::uint32_t last_row = side * side - side;
        switch (set) {
        case SampleSet::cross:
            return s + 1;
        case SampleSet::corners:
            return ((s & 1) != 0 ? side - 1 : 0) + ((s & 2) != 0 ? last_row : 0);
        case SampleSet::rest:
            s += s + 1 < side - 1 ? 1 : 2;   // past the corners of the first row,
            return s < last_row ? s : s + 1; // and of the last
        default:
            return s;
        }
    }

    /// Of the sample with this number, in pixels from the pixel's corner.
    template <class S>
    LANECAST_INLINE void at(std::uint32_t n, S& x, S& y) const {
        if (set == SampleSet::cross) { // up, down, left, right
            x = S(0.5) + (n == 3 ? -static_cast<S>(offset) : n == 4 ? static_cast<S>(offset) : S(0));
            y = S(0.5) + (n == 1 ? -static_cast<S>(offset) : n == 2 ? static_cast<S>(offset) : S(0));
        } else {
            x = (static_cast<S>(n % side) + S(0.5)) / static_cast<S>(side);
            y = (static_cast<S>(n / side) + S(0.5)) / static_cast<S>(side);
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
    }
}

/// The samples of the chosen pixels, a pixel's side by side; `take(pixel, s, colour)` for each, in order.
template <FloatBatch F, class Take>
void trace_samples(TileScratch<F>& scratch, const SamplePattern& pattern, Take&& take) {
    using S = Scalar<F>;
    const RenderJob& job = *scratch.wavefront.job;
    const PixelBatch<F>& pixels = scratch.pixels;
    RayQueue<F>& queue = scratch.camera;
    const std::uint32_t samples = pattern.count();
    // the ray that comes next when queueing, and when taking
    std::uint32_t pixel = 0, sample = 0, taken_pixel = 0, taken_sample = 0;
    const auto step = [&](std::uint32_t& p, std::uint32_t& s) {
        if (++s == samples) {
            s = 0;
            ++p;
        }
    };
    while (samples > 0 && pixel < pixels.chosen_count) {
        std::uint32_t n = 0;
        for (; n < batch_rays && pixel < pixels.chosen_count; ++n, step(pixel, sample)) {
            const std::uint32_t at = pixels.chosen[pixel], number = pattern.number(sample);
            S x, y;
            pattern.at(number, x, y);
            queue.rays.dir[0][n] = pixels.corner[0][at] + x;
            queue.rays.dir[1][n] = pixels.corner[1][at] + y;
            if (queue.seed != nullptr) queue.seed[n] = pixel_seed(pixels.x[at], pixels.y[at], number);
        }
        queue.count = n;
        camera_rays(job, queue);
        trace_queue(scratch.wavefront, queue, pattern.kind, 0);
        for (std::uint32_t i = 0; i < n; ++i, step(taken_pixel, taken_sample))
            take(pixels.chosen[taken_pixel], taken_sample, Vec3<S>{queue.color[0][i], queue.color[1][i], queue.color[2][i]});
    }
}

/// As above, added to `sum`.
template <FloatBatch F>
void add_samples(TileScratch<F>& scratch, const SamplePattern& pattern, Scalar<F>* const (&sum)[3]) {
    trace_samples(scratch, pattern, [&](std::uint32_t at, std::uint32_t, const Vec3<Scalar<F>>& color) {
        sum[0][at] += color.x;
        sum[1][at] += color.y;
        sum[2][at] += color.z;
    });
}

/// A grid where one sample does not do. An edge that crosses a pixel parts its centre from a neighbour's; whether it does cross
/// it, the grid's corner samples tell: a straight edge that parts none of them from the centre parts no two samples of the grid.
/// So few rays are spent beside edges, all of the grid on them. Two colours differ that do so, as seen, by more than one sample
/// of the grid changes between black and white.
template <FloatBatch F>
void refine_edges(TileScratch<F>& scratch, const Tile& region, const Tile& tile) {
    using S = Scalar<F>;
    const RenderJob& job = *scratch.wavefront.job;
    PixelBatch<F>& pixels = scratch.pixels;
    const auto side = static_cast<std::uint32_t>(job.samples);
    if (side < 2) return;
    const S limit = S(1) / static_cast<S>(side * side);
    choose_near_edges(pixels, region, limit);
    trace_samples(scratch, {SampleSet::corners, side, 0, RayKind::offset},
                  [&](std::uint32_t at, std::uint32_t s, const Vec3<S>& color) {
                      pixels.corner_color[s][0][at] = color.x;
                      pixels.corner_color[s][1][at] = color.y;
                      pixels.corner_color[s][2][at] = color.z;
                  });
    choose_crossed(pixels, job.film, tile, limit);
    add_samples(scratch, {SampleSet::rest, side, 0, RayKind::offset}, pixels.refined);
    write_chosen(job.film, tile, pixels, pixels.refined, side * side);
}

} // namespace lanecast::inline LANECAST_ISA
