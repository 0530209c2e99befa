#pragma once
// The tiles of a crop, on the absolute pixel grid, so that a crop renders the same tiles as the whole image where it can.

#include "render/kernel_table.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace lanecast {

/// Row by row; those at the border of `crop` are cut to it.
[[nodiscard]] inline std::vector<Tile> make_tiles(const Tile& crop, int tile_size) {
    std::vector<Tile> tiles;
    for (int y = crop.y0 / tile_size * tile_size; y < crop.y1; y += tile_size)
        for (int x = crop.x0 / tile_size * tile_size; x < crop.x1; x += tile_size)
            tiles.push_back({x > crop.x0 ? x : crop.x0, y > crop.y0 ? y : crop.y0,
                             x + tile_size < crop.x1 ? x + tile_size : crop.x1,
                             y + tile_size < crop.y1 ? y + tile_size : crop.y1});
    return tiles;
}

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
