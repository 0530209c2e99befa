#pragma once
// The pixels of a tile: their order, which of them want more samples, and their way to the film.

#include "render/kernel_table.hpp"
#include "render/kernels/rays.hpp"
#include "render/kernels/slots.hpp"

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
    S* refined[3];           ///< sums of the second pass, which replaces the first
    S* normal[3];            ///< of the centre ray's hit
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
    for (std::uint32_t i = 0; i < n; ++i) pixels.index_at[(pixels.y[i] - region.y0) * w + (pixels.x[i] - region.x0)] = i;
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
    const auto first_plane = static_cast<std::int32_t>(first_slot(job.scene, PrimitiveKind::plane));
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

} // namespace lanecast::inline LANECAST_ISA
