#pragma once
// The tiles of a crop, on the absolute pixel grid, so that a crop renders the same tiles as the whole image where it can.

#include "render/kernel_table.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lanecast {

/// Numbered row by row; those at the border of `crop` are cut to it. A rule rather than a list: tiles may be as small as a pixel.
struct TileGrid {
    Tile crop;
    int tile_size;
    int first_x, first_y; ///< in tiles
    int columns, rows;

    TileGrid(const Tile& crop_, int tile_size_)
        : crop(crop_), tile_size(tile_size_), first_x(crop_.x0 / tile_size_), first_y(crop_.y0 / tile_size_),
          columns((crop_.x1 - 1) / tile_size_ + 1 - first_x), rows((crop_.y1 - 1) / tile_size_ + 1 - first_y) {}

    [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
    [[nodiscard]] Tile at(std::size_t i) const {
        const int x = (first_x + static_cast<int>(i % static_cast<std::size_t>(columns))) * tile_size;
        const int y = (first_y + static_cast<int>(i / static_cast<std::size_t>(columns))) * tile_size;
        return {std::max(x, crop.x0), std::max(y, crop.y0), std::min(x + tile_size, crop.x1), std::min(y + tile_size, crop.y1)};
    }
};

/// x and y of the pixels of a square, in Morton order: neighbours in the list are neighbours in the image, so packets are
/// compact.
struct PixelOrder {
    std::uint32_t count = 0; ///< the arrays are longer, because kernels read whole vectors
    std::vector<std::int32_t> x, y;
};

[[nodiscard]] inline PixelOrder morton_order(int side) {
    PixelOrder order;
    const auto even_bits = [](std::uint32_t i) {
        i &= 0x55555555u;
        i = (i | (i >> 1)) & 0x33333333u;
        i = (i | (i >> 2)) & 0x0f0f0f0fu;
        i = (i | (i >> 4)) & 0x00ff00ffu;
        return static_cast<std::int32_t>((i | (i >> 8)) & 0xffffu);
    };
    const std::uint32_t square = std::bit_ceil(static_cast<std::uint32_t>(side));
    for (std::uint32_t i = 0; i < square * square; ++i) {
        const std::int32_t x = even_bits(i), y = even_bits(i >> 1);
        if (x >= side || y >= side) continue;
        order.x.push_back(x);
        order.y.push_back(y);
    }
    order.count = static_cast<std::uint32_t>(order.x.size());
    order.x.resize(order.x.size() + 16);
    order.y.resize(order.y.size() + 16);
    return order;
}

} // namespace lanecast
