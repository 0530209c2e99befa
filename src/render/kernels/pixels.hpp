#pragma once
// The pixels of a tile: their order, which of them want more samples, and their way to the film.

#include "render/kernel_table.hpp"
#include "render/kernels/rays.hpp"
#include "render/kernels/slots.hpp"

namespace lanecast::inline LANECAST_ISA {

/// Pixels that `edge` looks at around a tile: those whose neighbours' neighbours decide at its border.
inline constexpr std::int32_t edge_border = 2;

/// About as the eye and screens divide the range of a channel: the square root, from 0 for black to 1 for white.
template <class T>
LANECAST_INLINE T as_seen(T channel) {
    return sqrt(max(channel, T(0)));
}

/// The centre rays of a region row by row, as their neighbours see them.
template <FloatBatch F>
struct RowMajor {
    Scalar<F>* seen[3]; ///< colours as seen
    std::uint8_t* bent;
    std::uint8_t* near; ///< or a neighbour is; of the tile only

    void allocate(ScratchLayout& layout, std::uint64_t n) {
        layout.take3(seen, n);
        bent = layout.take<std::uint8_t>(n);
        near = layout.take<std::uint8_t>(n);
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
    S* corner_color[4][3]; ///< colours of the grid's corner samples
    S* refined[3];         ///< sums of the grid
    RowMajor<F> row_major;

    void allocate(ScratchLayout& layout, const RenderJob& job) {
        const bool edge = job.anti_alias == AntiAliasKind::edge;
        const std::uint64_t side = static_cast<std::uint64_t>(job.tile_size) + (edge ? 2u * edge_border : 0u);
        const std::uint64_t n = side * side + width<F>;
        x = layout.take<std::int32_t>(n);
        y = layout.take<std::int32_t>(n);
        corner[0] = layout.take<S>(n);
        corner[1] = layout.take<S>(n);
        layout.take3(sum, n);
        slot = layout.take<std::int32_t>(n);
        chosen = layout.take<std::uint32_t>(n);
        if (!edge) return;
        for (auto& color : corner_color) layout.take3(color, n);
        layout.take3(refined, n);
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

/// Where colour, along a row or a column, is off the line between the two neighbours: at steps, whichever side, but not where it
/// changes evenly. The outermost pixels of the region are compared with anything.
template <FloatBatch F>
void find_bends(RowMajor<F>& at, std::uint32_t row, std::uint32_t area, Scalar<F> limit) {
    for (std::uint32_t i = row; i < area - row; i += width<F>) {
        const auto bent = [&](const Scalar<F>* seen, std::uint32_t step) {
            return abs(load<F>(seen + i - step) + load<F>(seen + i + step) - F(2) * load<F>(seen + i)) > F(limit);
        };
        Mask<F> any_channel(false);
        for (const Scalar<F>* const seen : at.seen) any_channel = any_channel | bent(seen, 1) | bent(seen, row);
        const std::uint32_t lanes = bits(any_channel);
        for (std::uint32_t lane = 0; lane < width<F>; ++lane) at.bent[i + lane] = static_cast<std::uint8_t>((lanes >> lane) & 1u);
    }
}

/// Pixels of the tile that are bent, or one of whose eight neighbours is: that an edge ends between centres, or comes back behind
/// them, shows at the next pixel. The region is the tile and its border.
template <FloatBatch F>
void choose_near_edges(PixelBatch<F>& pixels, const Tile& region, Scalar<F> limit) {
    const std::int32_t row = region.x1 - region.x0, rows = region.y1 - region.y0;
    RowMajor<F>& at = pixels.row_major;
    const auto place = [&](std::uint32_t i) { return (pixels.y[i] - region.y0) * row + (pixels.x[i] - region.x0); };
    for (std::uint32_t i = 0; i < pixels.count; i += width<F>) // `refined` is free until corners are added to it
        for (int c = 0; c < 3; ++c) store(pixels.refined[c] + i, as_seen(load<F>(pixels.sum[c] + i)));
    for (std::uint32_t i = 0; i < pixels.count; ++i)
        for (int c = 0; c < 3; ++c) at.seen[c][place(i)] = pixels.refined[c][i];
    find_bends(at, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(row * rows), limit);

    // bytes may alias anything: without pointers of their own the loops are not vectorised
    const std::uint8_t* const bent = at.bent;
    std::uint8_t* const near = at.near;
    for (std::int32_t i = 0; i < row * rows; ++i) near[i] = 0;
    for (std::int32_t y = edge_border; y < rows - edge_border; ++y) {
        const std::int32_t end = (y + 1) * row - edge_border;
#pragma GCC ivdep
        for (std::int32_t i = y * row + edge_border; i < end; ++i) {
            const std::uint8_t *const above = bent + i - row, *const below = bent + i + row;
            near[i] = static_cast<std::uint8_t>(above[-1] | above[0] | above[1] | bent[i - 1] | bent[i] | bent[i + 1] |
                                                below[-1] | below[0] | below[1]);
        }
    }
    std::uint32_t chosen_count = 0;
    for (std::uint32_t i = 0; i < pixels.count; ++i) {
        pixels.chosen[chosen_count] = i;
        chosen_count += near[place(i)];
    }
    pixels.chosen_count = chosen_count;
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

/// Of the chosen pixels those stay in whose grid two opposite corners are off the line through the centre: they go on with the
/// sum of their corners. The others are written, as the mean of the five.
template <FloatBatch F>
void choose_crossed(PixelBatch<F>& pixels, const FilmView& film, const Tile& tile, Scalar<F> limit) {
    using S = Scalar<F>;
    const auto& corner = pixels.corner_color;
    std::uint32_t crossed_count = 0;
    for (std::uint32_t k = 0; k < pixels.chosen_count; ++k) {
        const std::uint32_t i = pixels.chosen[k];
        bool crossed = false;
        for (int c = 0; c < 3; ++c) {
            const S centre = as_seen(pixels.sum[c][i]);
            const auto bent = [&](int a, int b) {
                return abs(as_seen(corner[a][c][i]) + as_seen(corner[b][c][i]) - S(2) * centre) > limit;
            };
            crossed |= bent(0, 3) || bent(1, 2);
            pixels.refined[c][i] = (corner[0][c][i] + corner[1][c][i]) + (corner[2][c][i] + corner[3][c][i]);
        }
        if (crossed) {
            pixels.chosen[crossed_count++] = i;
            continue;
        }
        const std::int64_t at = film_index(film, tile, pixels, i);
        for (int c = 0; c < 3; ++c) film.rgb[c][at] = static_cast<float>((pixels.sum[c][i] + pixels.refined[c][i]) / S(5));
    }
    pixels.chosen_count = crossed_count;
}

} // namespace lanecast::inline LANECAST_ISA
