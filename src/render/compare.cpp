#include "render/compare.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace lanecast {
namespace {

/// Differences of 8-bit codes k/255, held as floats near 1, are off by some units of 2^-24: one code must not count as more than
/// one. Never more than a small part of the threshold: at 0, any difference is off.
[[nodiscard]] double with_rounding_of_codes(double threshold) noexcept { return threshold + std::min(1e-6, threshold / 64); }

[[nodiscard]] double difference(float a, float b) noexcept {
    if (a == b) return 0;
    const double d = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
}

/// As the eye judges differences: by the light there. 1/100 keeps the dark from deciding alone (Rousselle et al. 2011).
[[nodiscard]] double relative_square(double difference, float reference) noexcept {
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    const double r = static_cast<double>(reference);
    return std::isfinite(r) ? difference * difference / (r * r + 0.01) : 0; // equal infinities
}

/// Of the image; empty where x1 <= x0 or y1 <= y0.
[[nodiscard]] Tile common_window(const Film& a, const Film& b) noexcept {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x0 + a.width, b.x0 + b.width),
            std::min(a.y0 + a.height, b.y0 + b.height)};
}

[[nodiscard]] std::size_t index_of(const Film& film, int x, int y) noexcept {
    return static_cast<std::size_t>(y - film.y0) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x - film.x0);
}

[[nodiscard]] bool same_bits(std::span<const float> a, std::span<const float> b) noexcept {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

} // namespace

Comparison compare(const Film& a, const Film& b, double off_threshold) noexcept {
    Comparison result;
    result.same_size = a.image_width == b.image_width && a.image_height == b.image_height;
    if (!result.same_size) return result;
    result.same_window = a.x0 == b.x0 && a.y0 == b.y0 && a.width == b.width && a.height == b.height;
    result.identical = result.same_window;
    for (std::size_t c = 0; c < 3; ++c) result.identical = result.identical && same_bits(a.rgb[c], b.rgb[c]);

    const Tile common = common_window(a, b);
    const double limit = with_rounding_of_codes(off_threshold);
    double sum = 0, relative_sum = 0;
    for (int y = common.y0; y < common.y1; ++y)
        for (int x = common.x0; x < common.x1; ++x) {
            const std::size_t i = index_of(a, x, y), j = index_of(b, x, y);
            double worst = 0;
            for (int c = 0; c < 3; ++c) {
                const float value_a = a.rgb[static_cast<std::size_t>(c)][i], value_b = b.rgb[static_cast<std::size_t>(c)][j];
                const double d = difference(value_a, value_b);
                sum += d * d;
                relative_sum += relative_square(d, value_b);
                worst = std::max(worst, d);
                if (d > result.largest) {
                    result.largest = d;
                    result.largest_x = x, result.largest_y = y, result.largest_channel = c;
                    result.largest_a = value_a, result.largest_b = value_b;
                }
            }
            ++result.pixels;
            result.off_pixels += worst > limit ? 1 : 0;
        }
    if (result.pixels == 0) return result;
    const double values = 3.0 * static_cast<double>(result.pixels);
    result.rmse = std::sqrt(sum / values);
    result.relmse = relative_sum / values;
    return result;
}

double off_share(const Comparison& comparison) noexcept {
    return comparison.pixels == 0 ? 0 : static_cast<double>(comparison.off_pixels) / static_cast<double>(comparison.pixels);
}

Film difference_picture(const Film& a, const Film& b, float scale) {
    Tile common = common_window(a, b);
    common.x1 = std::max(common.x0, common.x1);
    common.y1 = std::max(common.y0, common.y1);
    Film film = make_film(a.image_width, a.image_height, common);
    for (int y = common.y0; y < common.y1; ++y)
        for (int x = common.x0; x < common.x1; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const double d = difference(a.rgb[c][index_of(a, x, y)], b.rgb[c][index_of(b, x, y)]);
                film.rgb[c][index_of(film, x, y)] = static_cast<float>(d * static_cast<double>(scale));
            }
    return film;
}

} // namespace lanecast
