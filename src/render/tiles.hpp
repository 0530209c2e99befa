#pragma once
// The tiles of a crop, on the absolute pixel grid, so that a crop renders the same tiles as the whole image where it can.

#include "render/kernel_table.hpp"

#include <vector>

namespace lanecast {

/// Row by row; those at the border of `crop` are cut to it.
[[nodiscard]] inline std::vector<Tile> make_tiles(const Tile& crop, int tile_size) {
    std::vector<Tile> tiles;
    for (int y = crop.y0 / tile_size * tile_size; y < crop.y1; y += tile_size)
        for (int x = crop.x0 / tile_size * tile_size; x < crop.x1; x += tile_size)
            tiles.push_back({x > crop.x0 ? x : crop.x0, y > crop.y0 ? y : crop.y0,
                             x + tile_size < crop.x1 ? x + tile_size : crop.x1, y + tile_size < crop.y1 ? y + tile_size : crop.y1});
    return tiles;
}

} // namespace lanecast
