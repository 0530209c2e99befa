#pragma once
// The picture: linear Rec.709 radiance, three planes, the part of the image that was rendered.

#include "render/kernel_table.hpp"
#include "scene/zero_pages.hpp"

#include <array>
#include <cstddef>

namespace lanecast {

/// Pixels x0 <= x < x0 + width of an image that is image_width wide; likewise y, downwards.
struct Film {
    int image_width = 0, image_height = 0;
    int x0 = 0, y0 = 0, width = 0, height = 0;
    std::array<ZeroVector<float>, 3> rgb; ///< each width * height, row by row from the top
};

/// Black, of memory that is not touched yet; throws std::bad_alloc.
[[nodiscard]] Film make_film(int image_width, int image_height, const Tile& crop);
[[nodiscard]] FilmView view(Film& film) noexcept;

} // namespace lanecast
