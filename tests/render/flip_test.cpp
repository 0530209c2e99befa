// FLIP: values of the authors' own program on pictures that a formula makes, and what must hold of any pictures.
#include "render/flip.hpp"

#include "output_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lanecast;
using namespace lanecast::test;

namespace {

template <class Value>
Film picture(int width, int height, const Value& value) {
    return film_of(width, height, {0, 0, width, height}, [&](int x, int y, int c) { return static_cast<float>(value(x, y, c)); });
}

/// In [0, 1], by a hash of the place.
double hashed(int x, int y, int c) {
    auto h = static_cast<std::uint32_t>(x * 7919 + y * 104729 + c * 1299709);
    h ^= h >> 13;
    h *= 0x5bd1e995u;
    h ^= h >> 15;
    return (h & 0xffffu) / 65535.0;
}

Film ramp(double red, double green, double blue) {
    return picture(64, 48, [=](int x, int, int c) { return (x + 0.5) / 64 * (c == 0 ? red : c == 1 ? green : blue); });
}
Film checker(int shift) {
    return picture(64, 48, [=](int x, int y, int) { return ((x + shift) / 8 + y / 8) % 2 ? 0.8 : 0.1; });
}
Film noise(int width = 64, int height = 48) { return picture(width, height, hashed); }
Film grey(int width = 64, int height = 48) {
    return picture(width, height, [](int, int, int) { return 0.5; });
}
Film pure(int channel) {
    return picture(64, 48, [=](int, int, int c) { return c == channel ? 1 : 0; });
}

double flip(const Film& a, const Film& b, PixelValues values = PixelValues::linear) {
    return mean_flip(see(a, values), see(b, values));
}

} // namespace

TEST_CASE("as the authors' program has it") {
    // the evaluator in C++ of its authors (docs/accuracy.md), at the default distance; it computes in float, and roots of small
    // differences of features magnify that
    CHECK(flip(ramp(1, 0.5, 0.25), ramp(0.9, 0.55, 0.3)) == doctest::Approx(0.179457).epsilon(1e-5));
    CHECK(flip(checker(0), checker(1)) == doctest::Approx(0.235994).epsilon(1e-4));
    CHECK(flip(noise(), grey()) == doctest::Approx(0.330661).epsilon(1e-5));
    CHECK(flip(noise(1, 1), grey(1, 1)) == doctest::Approx(0.960166).epsilon(1e-5));
    CHECK(flip(noise(), checker(0), PixelValues::codes) == doctest::Approx(0.725459).epsilon(1e-5));
}

TEST_CASE("0 of the same, 1 of green and blue, the same from either side, within 0 and 1") {
    CHECK(flip(noise(), noise()) == 0);
    CHECK(flip(pure(1), pure(2)) == doctest::Approx(1));
    const Film films[] = {ramp(1, 0.5, 0.25), checker(0), checker(1), noise(), grey(), pure(0), pure(1)};
    for (const Film& a : films)
        for (const Film& b : films) {
            const SeenPicture seen_a = see(a), seen_b = see(b);
            const std::vector<float> map = flip_map(seen_a, seen_b);
            CHECK(map.size() == 64 * 48);
            CHECK(std::all_of(map.begin(), map.end(), [](float v) { return v >= 0 && v <= 1; }));
            CHECK(map == flip_map(seen_b, seen_a));
        }
}

TEST_CASE("more noise, a larger shift of light and a larger part changed are more") {
    double before = 0;
    for (const double amount : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}) {
        const double now =
            flip(grey(), picture(64, 48, [=](int x, int y, int c) { return 0.5 + amount * (hashed(x, y, c) - 0.5); }));
        CHECK(now > before);
        before = now;
    }
    before = 0;
    for (const double amount : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}) {
        const double now = flip(grey(), picture(64, 48, [=](int, int, int) { return 0.5 + amount; }));
        CHECK(now > before);
        before = now;
    }
    before = 0;
    for (const int edge : {4, 16, 32, 48, 64}) {
        const double now = flip(grey(), picture(64, 48, [=](int x, int, int) { return x < edge ? 0.7 : 0.5; }));
        CHECK(now > before);
        before = now;
    }
}

TEST_CASE("seen from farther away, fine noise is less") {
    const Film a = grey(), b = noise();
    double before = 1;
    for (const double ppd : {10.0, 20.0, 40.0, 67.0, 120.0}) {
        const double now = mean_flip(see(a, PixelValues::linear, ppd), see(b, PixelValues::linear, ppd));
        CHECK(now < before);
        before = now;
    }
}

TEST_CASE("beyond what a screen shows nothing differs, and NaN is black") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto all = [](float value) { return picture(8, 8, [=](int, int, int) { return value; }); };
    CHECK(flip(all(1), all(50)) == 0);
    CHECK(flip(all(1), all(infinity)) == 0);
    CHECK(flip(all(0), all(-3)) == 0);
    CHECK(flip(all(0), all(nan)) == 0);
    CHECK(flip(all(0), all(1)) > 0.9);
    Film empty = make_film(8, 8, {0, 0, 0, 0});
    CHECK(flip(empty, empty) == 0);
}
