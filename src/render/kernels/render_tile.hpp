#pragma once
// A tile of the image: which rays its pixels ask for, and their average.

#include "render/kernels/camera.hpp"
#include "render/kernels/whitted.hpp"

namespace lanecast::inline LANECAST_ISA {

/// The pixels of a region, numbered row by row, with what their samples have added up to.
template <FloatBatch F>
struct PixelBatch {
    using S = Scalar<F>;
    Tile region;
    S* sum[3];
    S* refined[3];       ///< edge: sums of the second pass, which replaces the first
    std::int32_t* slot;  ///< of the centre ray
    S* normal[3];        ///< edge: of the centre ray
    std::uint32_t* list; ///< pixels to trace
    std::uint32_t count;

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        const auto side = static_cast<std::uint64_t>(job.tile_size) + 2; // edge: with the border
        const std::uint64_t n = side * side;
        layout.take3(sum, n);
        slot = layout.take<std::int32_t>(n);
        if (job.anti_alias == AntiAliasKind::edge) {
            layout.take3(refined, n);
            layout.take3(normal, n);
        }
        list = layout.take<std::uint32_t>(n);
        count = 0;
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

/// Every second bit of i: the x of Morton index i; y is that of i >> 1.
LANECAST_INLINE std::int32_t morton_even_bits(std::uint32_t i) {
    i &= 0x55555555u;
    i = (i | (i >> 1)) & 0x33333333u;
    i = (i | (i >> 2)) & 0x0f0f0f0fu;
    i = (i | (i >> 4)) & 0x00ff00ffu;
    return static_cast<std::int32_t>((i | (i >> 8)) & 0x0000ffffu);
}

/// Numbers the pixels of `region` row by row, and lists those of `tile`, a part of it, in Morton order.
template <FloatBatch F>
void list_pixels(PixelBatch<F>& pixels, const Tile& region, const Tile& tile) {
    const std::int32_t row = region.x1 - region.x0;
    const std::int32_t w = tile.x1 - tile.x0, h = tile.y1 - tile.y0;
    const std::uint32_t side = std::bit_ceil(static_cast<std::uint32_t>(w > h ? w : h));
    pixels.region = region;
    pixels.count = 0;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::int32_t x = morton_even_bits(i), y = morton_even_bits(i >> 1);
        if (x >= w || y >= h) continue;
        pixels.list[pixels.count++] =
            static_cast<std::uint32_t>((tile.y0 - region.y0 + y) * row + (tile.x0 - region.x0 + x));
    }
}

/// A hash of the pixel and its sample, for the rotation of soft shadows.
LANECAST_INLINE std::int32_t pixel_seed(std::int32_t x, std::int32_t y, std::uint32_t sample) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca6bu ^ sample * 0xc2b2ae35u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return static_cast<std::int32_t>(h ^ (h >> 15));
}

/// Sample s of a pass, in pixels from the pixel's corner.
struct SamplePattern {
    std::uint32_t samples;
    std::uint32_t side; ///< of the grid; 0: the four arms of the cross
    float offset;
    RayKind kind;

    template <class S>
    LANECAST_INLINE void at(std::uint32_t s, S& x, S& y) const {
        if (side == 0) { // up, down, left, right
            x = S(0.5) + (s == 2 ? -S(offset) : s == 3 ? S(offset) : S(0));
            y = S(0.5) + (s == 0 ? -S(offset) : s == 1 ? S(offset) : S(0));
        } else {
            x = (static_cast<S>(s % side) + S(0.5)) / static_cast<S>(side);
            y = (static_cast<S>(s / side) + S(0.5)) / static_cast<S>(side);
        }
    }
};

/// Normals of the batch's surfaces: the integrator's own are gone when it returns.
template <FloatBatch F>
void keep_normals(const SceneView& scene, const RayQueue<F>& queue, const std::uint32_t* places, Scalar<F>* const (&normal)[3]) {
    for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
        const Int<F> slot = load_int<F>(queue.rays.slot + i);
        const Mask<F> found = (slot > Int<F>(-1)) & first_lanes<F>(queue.count - i);
        if (none(found)) continue;
        const Vec3<F> n = surface_at<F>(scene, load<F>(queue.rays.org, i), load<F>(queue.rays.dir, i),
                                        load<F>(queue.rays.t + i), slot, found)
                              .normal;
        alignas(64) Scalar<F> lanes[3][width<F>];
        Scalar<F>* const rows[3] = {lanes[0], lanes[1], lanes[2]};
        store<F>(rows, 0, n);
        for_each_bit(bits(found), [&](std::uint32_t lane) {
            for (int c = 0; c < 3; ++c) normal[c][places[i + lane]] = lanes[c][lane];
        });
    }
}

/// Traces all samples of the listed pixels, a pixel's samples side by side, and adds them up in order.
template <FloatBatch F>
void trace_samples(TileScratch<F>& scratch, const SamplePattern& pattern, Scalar<F>* const (&sum)[3]) {
    using S = Scalar<F>;
    const RenderJob& job = *scratch.wavefront.job;
    PixelBatch<F>& pixels = scratch.pixels;
    RayQueue<F>& queue = scratch.camera;
    queue.rays.tmin = static_cast<S>(job.camera.near);
    const auto row = static_cast<std::uint32_t>(pixels.region.x1 - pixels.region.x0);
    const std::uint32_t total = pixels.count * pattern.samples;
    for (std::uint32_t begin = 0; begin < total; begin += batch_rays) {
        queue.count = total - begin < batch_rays ? total - begin : batch_rays;
        for (std::uint32_t i = 0; i < queue.count; ++i) {
            const std::uint32_t place = pixels.list[(begin + i) / pattern.samples], s = (begin + i) % pattern.samples;
            const std::int32_t x = pixels.region.x0 + static_cast<std::int32_t>(place % row);
            const std::int32_t y = pixels.region.y0 + static_cast<std::int32_t>(place / row);
            S in_x, in_y;
            pattern.at(s, in_x, in_y);
            queue.rays.dir[0][i] = static_cast<S>(x) + in_x;
            queue.rays.dir[1][i] = static_cast<S>(y) + in_y;
            if (queue.seed != nullptr) queue.seed[i] = pixel_seed(x, y, s);
        }
        const Vec3<F> org = splat<F>(job.camera.org);
        for (std::uint32_t i = 0; i < queue.count; i += width<F>) {
            const Vec3<F> dir = camera_direction<F>(job.camera, load<F>(queue.rays.dir[0] + i), load<F>(queue.rays.dir[1] + i));
            store<F>(queue.rays.org, i, org);
            store<F>(queue.rays.dir, i, dir);
            store(queue.rays.source + i, Int<F>(no_source));
            if (queue.weight != nullptr) store(queue.weight + i, F(1));
            if (queue.record != nullptr) store(queue.record + i, Int<F>(-1));
        }
        trace_queue(scratch.wavefront, queue, pattern.kind, 0);
        for (std::uint32_t i = 0; i < queue.count; ++i) {
            const std::uint32_t place = pixels.list[(begin + i) / pattern.samples];
            for (int c = 0; c < 3; ++c) sum[c][place] += queue.color[c][i];
            if (pattern.kind == RayKind::primary) pixels.slot[place] = queue.rays.slot[i];
        }
        if (pattern.kind == RayKind::primary && job.anti_alias == AntiAliasKind::edge)
            keep_normals<F>(job.scene, queue, pixels.list + begin, pixels.normal);
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

/// Keeps in the list only the pixels that differ from a neighbour inside the image.
template <FloatBatch F>
void keep_edges(const SceneView& scene, PixelBatch<F>& pixels) {
    const Tile& region = pixels.region;
    const auto row = static_cast<std::uint32_t>(region.x1 - region.x0);
    const auto rows = static_cast<std::uint32_t>(region.y1 - region.y0);
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < pixels.count; ++k) {
        const std::uint32_t place = pixels.list[k], x = place % row, y = place / row;
        const bool edge = (x > 0 && edge_between(scene, pixels, place - 1, place)) ||
                          (x + 1 < row && edge_between(scene, pixels, place, place + 1)) ||
                          (y > 0 && edge_between(scene, pixels, place - row, place)) ||
                          (y + 1 < rows && edge_between(scene, pixels, place, place + row));
        if (edge) pixels.list[kept++] = place;
    }
    pixels.count = kept;
}

template <FloatBatch F>
void write_film(const FilmView& film, const PixelBatch<F>& pixels, Scalar<F>* const (&sum)[3], std::uint32_t samples) {
    using S = Scalar<F>;
    const Tile& region = pixels.region;
    const auto row = static_cast<std::uint32_t>(region.x1 - region.x0);
    for (std::uint32_t k = 0; k < pixels.count; ++k) {
        const std::uint32_t place = pixels.list[k];
        const std::int64_t x = region.x0 + static_cast<std::int32_t>(place % row) - film.x0;
        const std::int64_t y = region.y0 + static_cast<std::int32_t>(place / row) - film.y0;
        for (int c = 0; c < 3; ++c) film.rgb[c][x + y * film.width] = static_cast<float>(sum[c][place] / static_cast<S>(samples));
    }
}

template <FloatBatch F>
void clear(const PixelBatch<F>& pixels, Scalar<F>* const (&sum)[3]) {
    const auto n = (pixels.region.x1 - pixels.region.x0) * (pixels.region.y1 - pixels.region.y0);
    for (Scalar<F>* const channel : sum)
        for (std::int32_t i = 0; i < n; ++i) channel[i] = 0;
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
    const auto side = static_cast<std::uint32_t>(job.samples);
    const bool grid = job.anti_alias == AntiAliasKind::grid;
    detail::list_pixels(pixels, region, region);
    detail::clear(pixels, pixels.sum);
    const detail::SamplePattern first{grid ? side * side : 1, grid ? side : 1, 0, RayKind::primary};
    detail::trace_samples(scratch, first, pixels.sum);
    if (job.anti_alias != AntiAliasKind::edge) detail::write_film(job.film, pixels, pixels.sum, first.samples);

    if (job.anti_alias == AntiAliasKind::cross) {
        std::uint32_t kept = 0;
        for (std::uint32_t k = 0; k < pixels.count; ++k) {
            const std::int32_t slot = pixels.slot[pixels.list[k]];
            const bool on_plane = slot >= static_cast<std::int32_t>(job.scene.first_slot[4]);
            if (slot >= 0 && (!on_plane || job.offset_planes != 0)) pixels.list[kept++] = pixels.list[k];
        }
        pixels.count = kept;
        detail::trace_samples(scratch, {4, 0, job.offset, RayKind::offset}, pixels.sum);
        detail::write_film(job.film, pixels, pixels.sum, 5);
    } else if (job.anti_alias == AntiAliasKind::edge) {
        detail::list_pixels(pixels, region, tile);
        detail::write_film(job.film, pixels, pixels.sum, 1);
        detail::keep_edges(job.scene, pixels);
        detail::clear(pixels, pixels.refined);
        detail::trace_samples(scratch, {side * side, side, 0, RayKind::offset}, pixels.refined);
        detail::write_film(job.film, pixels, pixels.refined, side * side);
    }
    stats.total_ticks = ticks() - begin;
    return stats;
}

} // namespace lanecast::inline LANECAST_ISA
