// Views: in range, monotone, equal for a crop and the whole, and what their formulae say.
#include "render/tonemap.hpp"

#include "output_support.hpp"
#include "render/dither_mask.hpp"
#include "render/srgb_curve.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr View all_views[] = {View::plain, View::srgb, View::reinhard, View::aces, View::neutral};

double srgb(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

/// The formulae again, in double: what a code is before dithering and rounding.
std::array<double, 3> expected_code(View view, std::array<double, 3> c) {
    for (double& x : c) {
        x = std::max(x, 0.0);
        if (view == View::reinhard) x = x / (1 + x);
        if (view == View::aces) x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    }
    if (view == View::neutral) { // after KhronosGroup/ToneMapping, PBR_Neutral/pbrNeutral.glsl
        const double low = std::min({c[0], c[1], c[2]});
        const double offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
        for (double& x : c) x -= offset;
        const double peak = std::max({c[0], c[1], c[2]});
        if (peak >= 0.76) {
            const double new_peak = 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
            const double g = 1 - 1 / (0.15 * (peak - new_peak) + 1);
            for (double& x : c) x = x * new_peak / peak * (1 - g) + new_peak * g;
        }
    }
    for (double& x : c) x = 255 * (view == View::plain ? std::clamp(x, 0.0, 1.0) : srgb(std::clamp(x, 0.0, 1.0)));
    return c;
}

std::uint8_t code_at(const Picture8& picture, int x, int y, int c) {
    return picture.rgb[static_cast<std::size_t>(3 * (y * picture.width + x) + c)];
}

/// Means over one mask of a picture of one colour.
std::array<double, 3> mean_codes(View view, float r, float g, float b, double exposure = 0) {
    const float color[3] = {r, g, b};
    const Picture8 picture =
        tonemap(film_of(dither_size, dither_size, {0, 0, dither_size, dither_size}, [&](int, int, int c) { return color[c]; }),
                view, exposure);
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) mean[i % 3] += picture.rgb[i] / double{dither_size * dither_size};
    return mean;
}

int steps_of(const SrgbCurve& curve, float value) { return lanecast::steps_of(curve, value, srgb_bucket(value)); }

} // namespace

TEST_CASE("the curve is sRGB's: thresholds where double says, one per bucket, increasing") {
    const SrgbCurve& curve = srgb_curve();
    REQUIRE(curve.threshold.size() == srgb_steps + 2);
    int wrong_place = 0, crowded = 0, not_increasing = 0, wrong_steps = 0;
    for (std::size_t q = 1; q <= srgb_steps; ++q) {
        const long double edge = (static_cast<long double>(q) - 0.5L) / srgb_steps;
        const long double linear = edge <= 0.04045L ? edge / 12.92L : std::pow((edge + 0.055L) / 1.055L, 2.4L);
        const float threshold = curve.threshold[q], before = std::nextafter(threshold, -1.0f);
        // The smallest float at or above, but for an ambiguity of the last bits of double.
        if (threshold < linear * (1 - 1e-15L) || before > linear * (1 + 1e-15L)) ++wrong_place;
        if (threshold <= curve.threshold[q - 1]) ++not_increasing;
        if (q > 1 && srgb_bucket(threshold) == srgb_bucket(curve.threshold[q - 1])) ++crowded;
        if (steps_of(curve, threshold) != static_cast<int>(q) || steps_of(curve, before) != static_cast<int>(q) - 1)
            ++wrong_steps;
    }
    CHECK(wrong_place == 0);
    CHECK(not_increasing == 0);
    CHECK(crowded == 0);
    CHECK(wrong_steps == 0);
    CHECK(steps_of(curve, 0.0f) == 0);
    CHECK(steps_of(curve, 1.0f) == srgb_steps);
}

TEST_CASE("plain rounds the clamped linear value, exactly") {
    for (int code = 0; code <= 255; ++code) {
        CHECK(mean_codes(View::plain, static_cast<float>(code) / 255.0f, 0, 0)[0] == code);
        if (code == 255) continue;
        const float edge = static_cast<float>((code + 0.5) / 255); // values on either side of a float's distance
        CHECK(mean_codes(View::plain, edge * (1 - 1e-6f), edge * (1 + 1e-6f), 0) ==
              std::array<double, 3>{double(code), code + 1.0, 0});
    }
    CHECK(mean_codes(View::plain, -1, 7, std::numeric_limits<float>::infinity()) == std::array<double, 3>{0, 255, 255});
}

TEST_CASE("each view's codes are its formula's, to the dither's 1/64") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-12, 9);
    for (const View view : all_views) {
        if (view == View::plain) continue;
        double worst = 0;
        for (int trial = 0; trial < 400; ++trial) {
            const float r = std::exp2(exponent(random)), g = std::exp2(exponent(random)),
                        b = trial % 4 ? std::exp2(exponent(random)) : -1.0f;
            const auto mean = mean_codes(view, r, g, b);
            const auto expected = expected_code(view, {r, g, b});
            for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(mean[c] - expected[c]));
        }
        CAPTURE(view_names[static_cast<std::size_t>(view)]);
        CHECK(worst <= 0.5 / 64 + 1e-3);
    }
}

TEST_CASE("every view: black is black, white is white, greys stay grey, brighter is never darker, NaN is black") {
    const int width = 4000;
    std::mt19937 random(2);
    for (const View view : all_views) {
        CAPTURE(view_names[static_cast<std::size_t>(view)]);
        // A grey ramp from 2^-14 to 2^130 (infinity), all at pixels of one dither level.
        const Film ramp = film_of(width * dither_size, 1, {0, 0, width * dither_size, 1}, [&](int x, int, int) {
            return static_cast<float>(std::exp2(-14 + 144.0 * (x / dither_size) / width));
        });
        const Picture8 picture = tonemap(ramp, view);
        int darker = 0, coloured = 0;
        for (int x = 0; x < ramp.width; ++x) {
            coloured +=
                code_at(picture, x, 0, 0) == code_at(picture, x, 0, 1) && code_at(picture, x, 0, 1) == code_at(picture, x, 0, 2)
                    ? 0
                    : 1;
            if (x >= dither_size) darker += code_at(picture, x, 0, 0) < code_at(picture, x - dither_size, 0, 0) ? 1 : 0;
        }
        CHECK(darker == 0);
        CHECK(coloured == 0);
        CHECK(code_at(picture, ramp.width - 1, 0, 0) == 255);
        CHECK(mean_codes(view, 0, -0.0f, -5) == std::array<double, 3>{0, 0, 0});
        const float nan = std::numeric_limits<float>::quiet_NaN();
        CHECK(mean_codes(view, nan, nan, -nan) == std::array<double, 3>{0, 0, 0});
        for (int trial = 0; trial < 2000; ++trial) { // one channel of any colour grows: that channel does not shrink
            const float g = std::abs(random_finite(random)), b = std::abs(random_finite(random));
            const float r =
                std::ldexp(1.0f + static_cast<float>(random() % 1000) / 1000.0f, static_cast<int>(random() % 20) - 12);
            Film film = film_of(2 * dither_size, 1, {0, 0, 2 * dither_size, 1}, [&](int x, int, int c) {
                return c == 1 ? g : c == 2 ? b : x ? 1.01f * r : r;
            });
            film.rgb[0][dither_size] = 1.01f * r;
            const Picture8 two = tonemap(film, view);
            if (view != View::neutral) CHECK(code_at(two, dither_size, 0, 0) >= code_at(two, 0, 0, 0)); // neutral mixes channels
        }
    }
}

TEST_CASE("the default view keeps typed colours: every value in [0, 1] arrives as its sRGB code") {
    CHECK(default_view == View::srgb);
    CHECK(mean_codes(default_view, 1, 1, 1) == std::array<double, 3>{255, 255, 255});
    const auto mean = mean_codes(default_view, 0.5f, 0.25f, 0.0f);
    CHECK(mean[0] == doctest::Approx(187.516).epsilon(1e-4));
    CHECK(mean[1] == doctest::Approx(136.958).epsilon(1e-4));
    CHECK(mean[2] == 0);
}

TEST_CASE("dithering differs from the value by less than a code, and by nothing on average") {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const float value = uniform(random);
        const double expected = 255 * srgb(static_cast<double>(value));
        const Picture8 picture =
            tonemap(film_of(dither_size, dither_size, {0, 0, dither_size, dither_size}, [&](int, int, int) { return value; }),
                    View::srgb);
        const auto [low, high] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
        CHECK(*high - *low <= 1);
        CHECK(std::abs(*low - expected) < 1);
        CHECK(std::abs(*high - expected) < 1);
        CHECK(std::abs(mean_codes(View::srgb, value, value, value)[0] - expected) < 0.5 / 64 + 1e-4);
    }
    // A ramp of a few codes over many pixels: local means follow it, where plain rounding would band.
    const int width = 4096, height = dither_size;
    const auto value_at = [&](int x) { return 0.2f + 0.02f * static_cast<float>(x) / width; };
    const Picture8 ramp =
        tonemap(film_of(width, height, {0, 0, width, height}, [&](int x, int, int) { return value_at(x); }), View::srgb);
    double worst = 0;
    for (int x0 = 0; x0 + dither_size <= width; x0 += dither_size) {
        double mean = 0, expected = 0;
        for (int x = x0; x < x0 + dither_size; ++x) {
            expected += 255 * srgb(static_cast<double>(value_at(x))) / dither_size;
            for (int y = 0; y < height; ++y) mean += code_at(ramp, x, y, 0) / double{dither_size * height};
        }
        worst = std::max(worst, std::abs(mean - expected));
    }
    CHECK(worst < 0.03);
}

TEST_CASE("a crop's bytes are the whole picture's there, and threads change nothing") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1.5f);
    const int width = 150, height = 300;
    const Film whole = film_of(width, height, {0, 0, width, height}, [&](int, int, int) { return uniform(random); });
    for (const View view : all_views) {
        const Picture8 picture = tonemap(whole, view, 0.3);
        for (const int threads : {2, 3, 16}) CHECK(tonemap(whole, view, 0.3, threads).rgb == picture.rgb);
        for (int trial = 0; trial < 40; ++trial) {
            const int x0 = static_cast<int>(random() % width), y0 = static_cast<int>(random() % height);
            const Tile crop{x0, y0, x0 + 1 + static_cast<int>(random() % static_cast<unsigned>(width - x0)),
                            y0 + 1 + static_cast<int>(random() % static_cast<unsigned>(height - y0))};
            const Film part = film_of(width, height, crop, [&](int x, int y, int c) {
                return whole.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>(y * width + x)];
            });
            const Picture8 cropped = tonemap(part, view, 0.3);
            int wrong = 0;
            for (int y = crop.y0; y < crop.y1; ++y)
                for (int x = crop.x0; x < crop.x1; ++x)
                    for (int c = 0; c < 3; ++c)
                        wrong += code_at(cropped, x - crop.x0, y - crop.y0, c) == code_at(picture, x, y, c) ? 0 : 1;
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("exposure is a factor of 2^EV before the view") {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0, 1);
    const Film film = film_of(64, 64, {0, 0, 64, 64}, [&](int, int, int) { return uniform(random); });
    for (const View view : all_views)
        for (const int stops : {-5, -1, 0, 1, 3}) {
            Film scaled = film;
            for (auto& plane : scaled.rgb)
                for (float& value : plane) value = std::ldexp(value, stops);
            CHECK(tonemap(film, view, stops).rgb == tonemap(scaled, view).rgb);
        }
    for (double stops = -8; stops < 8; stops += 0.37) {
        const double light = std::exp2(stops) * 0.002;
        CHECK(std::abs(mean_codes(View::srgb, 0.002f, 0, 0, stops)[0] - 255 * srgb(light)) <= 0.5 / 64 + 1e-4);
        CHECK(std::abs(mean_codes(View::plain, 0.002f, 0, 0, stops)[0] - 255 * light) <= 0.5 + 1e-4);
    }
    for (const double stops : {-3.5, -0.499, 0.3, 0.5, 1.7, 2.25}) {
        Film scaled = film;
        for (auto& plane : scaled.rgb)
            for (float& value : plane) value *= static_cast<float>(std::exp2(stops));
        CHECK(tonemap(film, View::srgb, stops).rgb == tonemap(scaled, View::srgb).rgb);
    }
    CHECK(mean_codes(View::srgb, 1, 1, 1, -1e300)[0] == 0);
    CHECK(mean_codes(View::srgb, 1, 1, 1, 1e300)[0] == 255);
}

TEST_CASE("views are found by name") {
    for (std::size_t i = 0; i < view_names.size(); ++i) CHECK(view_from_name(view_names[i]) == static_cast<View>(i));
    CHECK_FALSE(view_from_name("filmic"));
    CHECK_FALSE(view_from_name(""));
}
