#pragma once
// A tile of the image: which rays its pixels ask for, and their average.

#include "render/kernels/camera.hpp"
#include "render/kernels/whitted.hpp"

namespace lanecast::inline LANECAST_ISA {

/// The pixels of a region in Morton order, with what their samples have added up to.
template <FloatBatch F>
struct PixelBatch {
    using S = Scalar<F>;
    std::int32_t* x; ///< absolute
    std::int32_t* y;
    S* corner[2]; ///< x and y again, as the camera takes them
    S* sum[3];
    std::int32_t* slot; ///< of the centre ray
    std::uint32_t count;
    std::uint32_t* chosen; ///< of a second pass: indices of its pixels
    std::uint32_t chosen_count;
    // edge only
    S* refined[3]; ///< sums of the second pass, which replaces the first
    S* normal[3];  ///< of the centre ray's hit
    std::uint32_t* index_at; ///< of the pixel, row by row

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        const bool edge = job.anti_alias == AntiAliasKind::edge;
        const std::uint64_t side = static_cast<std::uint64_t>(job.tile_size) + (edge ? 2u : 0u);
        const std::uint64_t n = side * side + width<F>;
        x = layout.take<std::int32_t>(n);
        y = layout.take<std::int32_t>(n);
        corner[0] = layout.take<S>(n);
        corner[1] = layout.take<S>(n);
        layout.take3(sum, n);
        slot = layout.take<std::int32_t>(n);
        chosen = layout.take<std::uint32_t>(n);
        if (!edge) return;
        layout.take3(refined, n);
        layout.take3(normal, n);
        index_at = layout.take<std::uint32_t>(n);
    }
};

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

namespace detail {

/// `order` holds the pixels of a square that is no smaller than the region: job.pixel_order.
template <FloatBatch F>
void list_pixels(PixelBatch<F>& pixels, const RenderJob& job, const Tile& region) {
    const std::int32_t w = region.x1 - region.x0, h = region.y1 - region.y0;
    const Int<F> x0(region.x0), y0(region.y0);
    std::uint32_t n = 0;
    for (std::uint32_t i = 0; i < job.pixel_order_count; i += width<F>) {
        const Int<F> x = load_int<F>(job.pixel_order[0] + i), y = load_int<F>(job.pixel_order[1] + i);
        const Mask<F> wanted = (Int<F>(w) > x) & (Int<F>(h) > y) & first_lanes<F>(job.pixel_order_count - i);
        compress_store_int<F>(pixels.x + n, x + x0, wanted);
        compress_store_int<F>(pixels.y + n, y + y0, wanted);
        n += count_bits(bits(wanted));
    }
    pixels.count = n;
    for (std::uint32_t i = 0; i < n; i += width<F>) {
        store(pixels.corner[0] + i, static_cast<F>(to_float(load_int<F>(pixels.x + i))));
        store(pixels.corner[1] + i, static_cast<F>(to_float(load_int<F>(pixels.y + i))));
    }
    if (job.anti_alias != AntiAliasKind::edge) return;
    for (std::uint32_t i = 0; i < n; ++i)
        pixels.index_at[(pixels.y[i] - region.y0) * w + (pixels.x[i] - region.x0)] = i;
}

/// A hash of the pixel and its sample, for the rotation of soft shadows.
LANECAST_INLINE std::int32_t pixel_seed(std::int32_t x, std::int32_t y, std::uint32_t sample) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca6bu ^ sample * 0xc2b2ae35u;
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
        const Surface<F> s = surface_at<F>(scene, load<F>(queue.rays.org, i), load<F>(queue.rays.dir, i),
                                           load<F>(queue.rays.t + i), slot, found);
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
            for (std::uint32_t i = 0; i < queue.count; ++i) queue.seed[i] = pixel_seed(pixels.x[begin + i], pixels.y[begin + i], 0);
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
            if (queue.seed != nullptr) queue.seed[n] = pixel_seed(pixels.x[at], pixels.y[at], sample);
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

template <FloatBatch F>
void clear(std::uint32_t count, Scalar<F>* const (&sum)[3]) {
    for (Scalar<F>* const channel : sum)
        for (std::uint32_t i = 0; i < count; ++i) channel[i] = 0;
}

template <FloatBatch F>
void choose_all(PixelBatch<F>& pixels) {
    for (std::uint32_t i = 0; i < pixels.count; ++i) pixels.chosen[i] = i;
    pixels.chosen_count = pixels.count;
}

/// Pixels whose centre ray hits something.
template <FloatBatch F>
void choose_hits(const RenderJob& job, PixelBatch<F>& pixels) {
    const auto first_plane = static_cast<std::int32_t>(job.scene.first_slot[4]);
    pixels.chosen_count = 0;
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        const bool wanted = pixels.slot[i] >= 0 && (pixels.slot[i] < first_plane || job.offset_planes != 0);
        if (wanted) pixels.chosen[pixels.chosen_count++] = i;
    }
}

/// Whether two neighbours look so different that one sample does not do: another object, a crease, or a step in colour.
template <FloatBatch F>
bool edge_between(const SceneView& scene, const PixelBatch<F>& pixels, std::uint32_t a, std::uint32_t b) {
    using S = Scalar<F>;
    const std::int32_t slot_a = pixels.slot[a], slot_b = pixels.slot[b];
    const auto object = [&](std::int32_t slot) { return slot < 0 ? -1 : static_cast<std::int32_t>(scene.object[slot]); };
    if (object(slot_a) != object(slot_b)) return true;
    if (slot_a >= 0) {
        S cos_angle(0);
        for (int c = 0; c < 3; ++c) cos_angle += pixels.normal[c][a] * pixels.normal[c][b];
        if (cos_angle < S(0.9)) return true;
    }
    for (int c = 0; c < 3; ++c) {
        const S va = pixels.sum[c][a], vb = pixels.sum[c][b];
        if (abs(va - vb) > S(0.03) * (S(0.25) + max(abs(va), abs(vb)))) return true;
    }
    return false;
}

/// Pixels of `tile` that differ from one of their four neighbours inside the region.
template <FloatBatch F>
void choose_edges(const SceneView& scene, PixelBatch<F>& pixels, const Tile& region, const Tile& tile) {
    const std::int32_t row = region.x1 - region.x0, rows = region.y1 - region.y0;
    pixels.chosen_count = 0;
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        if (pixels.x[i] < tile.x0 || pixels.x[i] >= tile.x1 || pixels.y[i] < tile.y0 || pixels.y[i] >= tile.y1) continue;
        const std::int32_t x = pixels.x[i] - region.x0, y = pixels.y[i] - region.y0;
        const auto differs = [&](std::int32_t dx, std::int32_t dy) {
            const std::int32_t nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= row || ny >= rows) return false;
            return edge_between(scene, pixels, pixels.index_at[ny * row + nx], i);
        };
        if (differs(-1, 0) || differs(1, 0) || differs(0, -1) || differs(0, 1)) pixels.chosen[pixels.chosen_count++] = i;
    }
}

/// Where pixel i of the region is on the film; negative for the border around the tile.
template <FloatBatch F>
LANECAST_INLINE std::int64_t film_index(const FilmView& film, const Tile& tile, const PixelBatch<F>& pixels, std::uint32_t i) {
    const std::int32_t x = pixels.x[i], y = pixels.y[i];
    if (x < tile.x0 || x >= tile.x1 || y < tile.y0 || y >= tile.y1) return -1;
    return (x - film.x0) + static_cast<std::int64_t>(y - film.y0) * film.width;
}

/// The first pass, one sample per pixel.
template <FloatBatch F>
void write_all(const FilmView& film, const Tile& tile, const PixelBatch<F>& pixels) {
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        const std::int64_t at = film_index(film, tile, pixels, i);
        if (at < 0) continue;
        for (int c = 0; c < 3; ++c) film.rgb[c][at] = static_cast<float>(pixels.sum[c][i]);
    }
}

/// Averages of the chosen pixels.
template <FloatBatch F>
void write_chosen(const FilmView& film, const Tile& tile, const PixelBatch<F>& pixels, Scalar<F>* const (&sum)[3],
                  std::uint32_t samples) {
    for (std::uint32_t k = 0; k < pixels.chosen_count; ++k) {
        const std::uint32_t i = pixels.chosen[k];
        const std::int64_t at = film_index(film, tile, pixels, i);
        if (at < 0) continue;
        for (int c = 0; c < 3; ++c) film.rgb[c][at] = static_cast<float>(sum[c][i] / static_cast<Scalar<F>>(samples));
    }
}

} // namespace detail

template <FloatBatch F>
TileStats render_tile(const RenderJob& job, const Tile& tile, void* memory) {
    const std::uint64_t begin = ticks();
    const FlushDenormals flush;
    TileStats stats{};
    TileScratch<F> scratch;
    ScratchLayout layout(memory);
    scratch.allocate(layout, job);
    scratch.wavefront.stats = &stats;
    PixelBatch<F>& pixels = scratch.pixels;

    Tile region = tile;
    if (job.anti_alias == AntiAliasKind::edge) { // the neighbours that decide at the tile's border
        region.x0 -= tile.x0 > 0 ? 1 : 0;
        region.y0 -= tile.y0 > 0 ? 1 : 0;
        region.x1 += tile.x1 < job.image_width ? 1 : 0;
        region.y1 += tile.y1 < job.image_height ? 1 : 0;
    }
    detail::list_pixels(pixels, job, region);
    const auto side = static_cast<std::uint32_t>(job.samples);
    if (job.anti_alias == AntiAliasKind::grid) {
        detail::choose_all(pixels);
        detail::clear<F>(pixels.count, pixels.sum);
        detail::trace_samples(scratch, {side * side, side, 0, RayKind::primary}, pixels.sum);
        detail::write_chosen(job.film, tile, pixels, pixels.sum, side * side);
    } else {
        detail::trace_centres(scratch);
        detail::write_all(job.film, tile, pixels);
    }
    if (job.anti_alias == AntiAliasKind::cross) {
        detail::choose_hits(job, pixels);
        detail::trace_samples(scratch, {4, 0, job.offset, RayKind::offset}, pixels.sum);
        detail::write_chosen(job.film, tile, pixels, pixels.sum, 5);
    } else if (job.anti_alias == AntiAliasKind::edge) {
        detail::choose_edges(job.scene, pixels, region, tile);
        detail::clear<F>(pixels.count, pixels.refined);
        detail::trace_samples(scratch, {side * side, side, 0, RayKind::offset}, pixels.refined);
        detail::write_chosen(job.film, tile, pixels, pixels.refined, side * side);
    }
    stats.total_ticks = ticks() - begin;
    return stats;
}

} // namespace lanecast::inline LANECAST_ISA
