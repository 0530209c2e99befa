// Distances between pictures.
#include "render/compare.hpp"

#include "output_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

Film random_film(unsigned seed, int width = 23, int height = 17) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 3);
    return film_of(width, height, {0, 0, width, height}, [&](int, int, int) { return uniform(random); });
}

float& value_at(Film& film, int x, int y, int c) {
    return film.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>((y - film.y0) * film.width + x - film.x0)];
}

} // namespace

TEST_CASE("a film does not differ from itself") {
    const Film film = random_film(1);
    const Comparison same = compare(film, film);
    CHECK(same.identical);
    CHECK(same.same_size);
    CHECK(same.same_window);
    CHECK(same.pixels == 23 * 17);
    CHECK(same.rmse == 0);
    CHECK(same.largest == 0);
    CHECK(same.off_pixels == 0);
    CHECK(off_share(same) == 0);
}

TEST_CASE("a known difference is found, with its size, its place and its share, from either side") {
    std::mt19937 random(2);
    for (int trial = 0; trial < 3000; ++trial) {
        const Film a = random_film(3);
        Film b = a;
        const int x = static_cast<int>(random() % 23), y = static_cast<int>(random() % 17), c = static_cast<int>(random() % 3);
        const float step = std::ldexp(random() % 2 ? 1.0f : -1.0f, -static_cast<int>(random() % 16));
        value_at(b, x, y, c) += step;
        const double d = std::abs(static_cast<double>(value_at(b, x, y, c)) -
                                  static_cast<double>(a.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>(y * 23 + x)]));
        for (const bool swapped : {false, true}) {
            const Comparison found = swapped ? compare(b, a) : compare(a, b);
            REQUIRE(found.largest == d);
            REQUIRE(found.largest_x == x);
            REQUIRE(found.largest_y == y);
            REQUIRE(found.largest_channel == c);
            REQUIRE((swapped ? found.largest_a : found.largest_b) == value_at(b, x, y, c));
            REQUIRE(found.rmse == doctest::Approx(d / std::sqrt(3.0 * 23 * 17)));
            REQUIRE(found.off_pixels == (d > 1.0 / 255 ? 1 : 0));
            REQUIRE_FALSE(found.identical);
        }
    }
}

TEST_CASE("RMSE is over pixels and channels; a pixel is off once, whatever its channels") {
    const auto constant = [](float r, float g, float b) {
        return film_of(4, 5, {0, 0, 4, 5}, [=](int, int, int c) { return c == 0 ? r : c == 1 ? g : b; });
    };
    const Comparison found = compare(constant(0, 0, 0), constant(3, 0, 4));
    CHECK(found.rmse == doctest::Approx(std::sqrt(25.0 / 3)));
    CHECK(found.largest == 4);
    CHECK(found.largest_channel == 2);
    CHECK(found.off_pixels == 20);
    CHECK(off_share(found) == 1);
    CHECK(compare(constant(0, 0, 0), constant(3, 0, 4), 4.5).off_pixels == 0);
}

TEST_CASE("one code of 255 is not off, two are") {
    for (int code = 0; code + 2 <= 255; ++code) {
        const auto codes = [](int k) {
            return film_of(1, 1, {0, 0, 1, 1}, [=](int, int, int) { return static_cast<float>(k) / 255.0f; });
        };
        CHECK(compare(codes(code), codes(code + 1)).off_pixels == 0);
        CHECK(compare(codes(code + 2), codes(code)).off_pixels == 1);
    }
}

TEST_CASE("a threshold below the rounding of codes is kept, too") {
    const Film a = random_film(5);
    Film b = a;
    float& value = value_at(b, 1, 2, 0);
    value = std::nextafter(value, infinity);
    const double d = compare(a, b).largest;
    CHECK(d > 0);
    CHECK(compare(a, b, 0).off_pixels == 1);
    CHECK(compare(a, b, 0.9 * d).off_pixels == 1);
    CHECK(compare(a, b, d).off_pixels == 0);
    CHECK(compare(a, b, 1.1 * d).off_pixels == 0);
}

TEST_CASE("NaN and infinity differ infinitely, but for equal infinities") {
    for (const float bad : {not_a_number, infinity, -infinity}) {
        const Film a = random_film(4);
        Film b = a;
        value_at(b, 5, 6, 1) = bad;
        for (const Comparison& found : {compare(a, b), compare(b, a)}) {
            CHECK(found.largest == infinity);
            CHECK(found.rmse == infinity);
            CHECK(found.largest_x == 5);
            CHECK(found.largest_y == 6);
            CHECK(found.largest_channel == 1);
            CHECK(found.off_pixels == 1);
        }
        const Comparison with_itself = compare(b, b);
        CHECK(with_itself.largest == (std::isnan(bad) ? infinity : 0.0f)); // a NaN is a fault wherever it is
        CHECK(difference_picture(a, b, 2.0f).rgb[1][6 * 23 + 5] == infinity);
    }
    const auto single = [](float v) { return film_of(1, 1, {0, 0, 1, 1}, [=](int, int, int) { return v; }); };
    CHECK(compare(single(infinity), single(-infinity)).largest == infinity);
    CHECK(compare(single(3e38f), single(-3e38f)).largest == doctest::Approx(6e38));
}

TEST_CASE("zeros of either sign are equal, but not identical") {
    const Film a = film_of(2, 2, {0, 0, 2, 2}, [](int, int, int) { return 0.0f; });
    Film b = a;
    b.rgb[2][3] = -0.0f;
    CHECK(compare(a, b).largest == 0);
    CHECK_FALSE(compare(a, b).identical);
}

TEST_CASE("sizes must agree; of different windows the common pixels are compared") {
    CHECK_FALSE(compare(random_film(1, 8, 9), random_film(1, 9, 8)).same_size);
    CHECK(compare(random_film(1, 8, 9), random_film(1, 9, 8)).pixels == 0);
    const auto value = [](int x, int y, int c) { return static_cast<float>(x + 100 * y + 10000 * c); };
    const Film whole = film_of(40, 30, {0, 0, 40, 30}, value);
    Film crop = film_of(40, 30, {5, 6, 25, 16}, value);
    Comparison found = compare(whole, crop);
    CHECK(found.same_size);
    CHECK_FALSE(found.same_window);
    CHECK_FALSE(found.identical);
    CHECK(found.pixels == 200);
    CHECK(found.largest == 0);
    value_at(crop, 24, 15, 0) += 7;
    found = compare(crop, whole);
    CHECK(found.largest == 7);
    CHECK(found.largest_x == 24);
    CHECK(found.largest_y == 15);
    CHECK(compare(crop, film_of(40, 30, {25, 6, 40, 16}, value)).pixels == 0); // side by side

    const Film picture = difference_picture(whole, crop, 0.5f);
    CHECK(picture.image_width == 40);
    CHECK(picture.x0 == 5);
    CHECK(picture.width == 20);
    CHECK(picture.height == 10);
    CHECK(picture.rgb[0].back() == 3.5f);
    CHECK(std::count(picture.rgb[0].begin(), picture.rgb[0].end(), 0.0f) == 199);
}

TEST_CASE("relMSE: squares over those of the second picture and a hundredth") {
    const auto one = [](float value) {
        return film_of(1, 1, {0, 0, 1, 1}, [&](int, int, int c) { return c == 0 ? value : 0.0f; });
    };
    CHECK(compare(one(0.5f), one(0.5f)).relmse == 0);
    CHECK(compare(one(0.75f), one(0.5f)).relmse == doctest::Approx(0.0625 / (0.25 + 0.01) / 3).epsilon(1e-12));
    CHECK(compare(one(0.5f), one(0.75f)).relmse == doctest::Approx(0.0625 / (0.5625 + 0.01) / 3).epsilon(1e-12));
    CHECK(compare(one(0.125f), one(0)).relmse == doctest::Approx(0.015625 / 0.01 / 3).epsilon(1e-12));
    CHECK(compare(one(infinity), one(infinity)).relmse == 0);
    CHECK(std::isinf(compare(one(infinity), one(1)).relmse));
    CHECK(std::isinf(compare(one(1), one(infinity)).relmse));
    CHECK(std::isinf(compare(one(not_a_number), one(1)).relmse));
    CHECK(std::isinf(compare(one(1), one(not_a_number)).relmse));
}
