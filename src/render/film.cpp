#include "render/film.hpp"

#include "scene/huge_pages.hpp"

namespace lanecast {

Film make_film(int image_width, int image_height, const Tile& crop) {
    Film film;
    film.image_width = image_width;
    film.image_height = image_height;
    film.x0 = crop.x0;
    film.y0 = crop.y0;
    film.width = crop.x1 - crop.x0;
    film.height = crop.y1 - crop.y0;
    for (auto& plane : film.rgb) {
        plane.resize(static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height));
        prefer_huge_pages(plane.data(), plane.size() * sizeof(float)); // measured: docs/performance.md
    }
    return film;
}

FilmView view(Film& film) noexcept {
    return {{film.rgb[0].data(), film.rgb[1].data(), film.rgb[2].data()}, film.x0, film.y0, film.width, film.height};
}

} // namespace lanecast
