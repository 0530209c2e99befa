#pragma once
// The pixels of a tile: their order, which of them want more samples, and their way to the film.

#include "render/kernel_table.hpp"
#include "render/kernels/rays.hpp"
#include "render/kernels/slots.hpp"

namespace lanecast::inline LANECAST_ISA {

/// The pixels of a region row by row, as their neighbours see them.
template <FloatBatch F>
struct RowMajor {
    Scalar<F>*normal[3], *colour[3]; ///< of the centre ray
    std::int32_t* object;            ///< -1: background
    std::uint8_t* differs;

    void allocate(ScratchLayout& layout, std::uint64_t n) {
        layout.take3(normal, n);
        layout.take3(colour, n);
        object = layout.take<std::int32_t>(n);
        differs = layout.take<std::uint8_t>(n);
    }
};

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
    RowMajor<F> row_major;

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
        row_major.allocate(layout, n + side);
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

/// Bit 0 of row_major.differs: where one sample does not do between a pixel and its neighbour to the right, for there is another
/// object, a crease, or a step in colour; bit 1: and the one below. The last column and row are compared with anything.
template <FloatBatch F>
void compare_neighbours(RowMajor<F>& at, std::uint32_t row, std::uint32_t area) {
    using S = Scalar<F>;
    for (std::uint32_t i = 0; i < area; i += width<F>) {
        const auto differ = [&](std::uint32_t j) {
            const auto step = [&](const S* channel) {
                const F a = load<F>(channel + i), b = load<F>(channel + j);
                return abs(a - b) > F(S(0.03)) * (F(S(0.25)) + max(abs(a), abs(b)));
            };
            const Int<F> object = load_int<F>(at.object + i);
            const Mask<F> same = object == load_int<F>(at.object + j);
            const F cos_angle = dot(load<F>(at.normal, i), load<F>(at.normal, j));
            const Mask<F> crease = Mask<F>((object > Int<F>(-1)) & (cos_angle < F(S(0.9))));
            return bits(Mask<F>((!same) | crease | step(at.colour[0]) | step(at.colour[1]) | step(at.colour[2])));
        };
        const std::uint32_t right = differ(i + 1), below = differ(i + row);
        for (std::uint32_t lane = 0; lane < width<F>; ++lane)
            at.differs[i + lane] = static_cast<std::uint8_t>(((right >> lane) & 1u) | (((below >> lane) & 1u) << 1));
    }
}

/// Pixels of `tile` that differ from one of their four neighbours inside the region. Each pair is compared once.
template <FloatBatch F>
void choose_edges(const SceneView& scene, PixelBatch<F>& pixels, const Tile& region, const Tile& tile) {
    const std::int32_t row = region.x1 - region.x0, rows = region.y1 - region.y0;
    RowMajor<F>& row_major = pixels.row_major;
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        const std::int32_t at = (pixels.y[i] - region.y0) * row + (pixels.x[i] - region.x0);
        const std::int32_t slot = pixels.slot[i];
        row_major.object[at] = slot < 0 ? -1 : static_cast<std::int32_t>(scene.object[slot]);
        for (int c = 0; c < 3; ++c) {
            row_major.normal[c][at] = pixels.normal[c][i];
            row_major.colour[c][at] = pixels.sum[c][i];
        }
    }
    compare_neighbours(row_major, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(row * rows));
    pixels.chosen_count = 0;
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        if (pixels.x[i] < tile.x0 || pixels.x[i] >= tile.x1 || pixels.y[i] < tile.y0 || pixels.y[i] >= tile.y1) continue;
        const std::int32_t x = pixels.x[i] - region.x0, y = pixels.y[i] - region.y0;
        const std::uint8_t* const here = row_major.differs + y * row + x;
        const bool edge = (x + 1 < row && (here[0] & 1) != 0) || (x > 0 && (here[-1] & 1) != 0) ||
                          (y + 1 < rows && (here[0] & 2) != 0) || (y > 0 && (here[-row] & 2) != 0);
        if (edge) pixels.chosen[pixels.chosen_count++] = i;
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
