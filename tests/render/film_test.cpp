#include "render/film.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

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

TEST_CASE("a film is black, whatever its memory was before") {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> side(1, 400);
    for (int draw = 0; draw < 300; ++draw) {
        Film film = make_film(400, 400, {0, 0, side(random), side(random)});
        float largest = 0;
        for (auto& plane : film.rgb) {
            for (const float value : plane) largest = std::max(largest, std::abs(value));
            std::fill(plane.begin(), plane.end(), 1.0f);
        }
        CHECK(largest == 0.0f);
    }
}
