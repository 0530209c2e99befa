#include "render/film.hpp"

#include <doctest/doctest.h>

using namespace lanecast;

TEST_CASE("a film holds the crop, black") {
    Film film = make_film(10, 8, {2, 3, 9, 8});
    CHECK(film.width == 7);
    CHECK(film.height == 5);
    for (const auto& plane : film.rgb) {
        REQUIRE(plane.size() == 35);
        for (const float value : plane) CHECK(value == 0.0f);
    }
    const FilmView film_view = view(film);
    CHECK(film_view.x0 == 2);
    CHECK(film_view.y0 == 3);
    CHECK(film_view.rgb[1] == film.rgb[1].data());
}
