#include "render/tonemap.hpp"

#include "render/dither_mask.hpp"
#include "render/parallel_rows.hpp"
#include "render/srgb_curve.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast {
namespace {

struct Color {
    float r, g, b;
};

// Beyond this every view has reached white, and no formula below overflows.
constexpr float brightest = 65504.0f;

/// In [0, brightest]; NaN becomes 0.
[[nodiscard]] float exposed(float value, float scale) noexcept {
    const float light = value * scale;
    return light > 0.0f ? std::min(light, brightest) : 0.0f;
}

[[nodiscard]] Color identity(Color c) noexcept { return c; }

[[nodiscard]] Color reinhard(Color c) noexcept { return {c.r / (1.0f + c.r), c.g / (1.0f + c.g), c.b / (1.0f + c.b)}; }

[[nodiscard]] float narkowicz(float x) noexcept { return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f); }

[[nodiscard]] Color aces(Color c) noexcept { return {narkowicz(c.r), narkowicz(c.g), narkowicz(c.b)}; }

[[nodiscard]] Color neutral(Color c) noexcept {
    constexpr float start = 0.8f - 0.04f, span = 1.0f - start, desaturation = 0.15f;
    const float low = std::min({c.r, c.g, c.b});
    const float offset = low < 0.08f ? low - 6.25f * low * low : 0.04f;
    c = {c.r - offset, c.g - offset, c.b - offset};
    const float peak = std::max({c.r, c.g, c.b});
    if (peak < start) return c;
    const float new_peak = 1.0f - span * span / (peak + span - start);
    const float scale = new_peak / peak;
    const float white = 1.0f - 1.0f / (desaturation * (peak - new_peak) + 1.0f);
    const auto mix = [&](float x) { return x * scale * (1.0f - white) + new_peak * white; };
    return {mix(c.r), mix(c.g), mix(c.b)};
}

[[nodiscard]] std::uint8_t plain_code(float light) noexcept {
    return static_cast<std::uint8_t>(255.0 * static_cast<double>(std::min(light, 1.0f)) +
                                     0.5); // exact but for the final truncation
}

void plain_row(const Film& film, std::size_t first, float scale, std::uint8_t* out) noexcept {
    for (std::size_t i = first; i < first + static_cast<std::size_t>(film.width); ++i)
        for (const auto& plane : film.rgb) *out++ = plain_code(exposed(plane[i], scale));
}

/// floor(code + (level + 1/2) / levels) for a code in 64ths: over the mask's levels its mean is the code.
[[nodiscard]] std::uint8_t dithered(int steps, int level) noexcept {
    static_assert(srgb_steps_per_code == dither_levels);
    return static_cast<std::uint8_t>((steps + level) / dither_levels);
}

/// Piece by piece in two passes, of which the first is vectors: roots are most of the work.
template <Color (*tone)(Color) noexcept>
void curved_row(const Film& film, std::size_t first, int y, float scale, std::uint8_t* out) noexcept {
    constexpr int piece = 128;
    const SrgbCurve& curve = srgb_curve();
    const std::uint8_t(&levels)[dither_size] = dither_mask[static_cast<unsigned>(y) % dither_size];
    float light[3][piece];
    int bucket[3][piece];
    for (int start = 0; start < film.width; start += piece) {
        const int count = std::min(piece, film.width - start);
        const std::size_t at = first + static_cast<std::size_t>(start);
        const float *red = film.rgb[0].data() + at, *green = film.rgb[1].data() + at, *blue = film.rgb[2].data() + at;
        for (int i = 0; i < count; ++i) {
            const Color c = tone({exposed(red[i], scale), exposed(green[i], scale), exposed(blue[i], scale)});
            light[0][i] = c.r, light[1][i] = c.g, light[2][i] = c.b;
        }
        for (int channel = 0; channel < 3; ++channel)
            for (int i = 0; i < count; ++i) {
                light[channel][i] = std::clamp(light[channel][i], 0.0f, 1.0f);
                bucket[channel][i] = srgb_bucket(light[channel][i]);
            }
        for (int i = 0; i < count; ++i) {
            const int level = levels[static_cast<unsigned>(film.x0 + start + i) % dither_size]; // one for all: greys stay grey
            for (int channel = 0; channel < 3; ++channel)
                *out++ = dithered(steps_of(curve, light[channel][i], bucket[channel][i]), level);
        }
    }
}

/// 2^x for |x| up to some hundreds, by IEEE operations: the library's differs in the last bit between machines.
[[nodiscard]] double exp2_of(double x) noexcept {
    const double whole = std::nearbyint(x), y = (x - whole) * 0.69314718055994530942;
    double sum = 1;
    for (int n = 16; n >= 1; --n) sum = 1 + sum * y / n; // |y| < 0.35: the next term is below 2^-70
    return std::ldexp(sum, static_cast<int>(whole));
}

} // namespace

std::optional<View> view_from_name(std::string_view name) noexcept {
    for (std::size_t i = 0; i < view_names.size(); ++i)
        if (view_names[i] == name) return static_cast<View>(i);
    return std::nullopt;
}

Picture8 tonemap(const Film& film, View view, double exposure, int threads) {
    const float scale = static_cast<float>(exp2_of(std::clamp(exposure, -100.0, 100.0)));
    const std::size_t width = static_cast<std::size_t>(film.width), height = static_cast<std::size_t>(film.height);
    Picture8 picture{film.width, film.height, ZeroVector<std::uint8_t>(3 * width * height)};
    for_each_row_band(film.height, threads, [&](int first_row, int last_row) {
        for (int row = first_row; row < last_row; ++row) {
            const std::size_t first = static_cast<std::size_t>(row) * width;
            std::uint8_t* out = picture.rgb.data() + 3 * first;
            const int y = film.y0 + row;
            switch (view) {
            case View::plain:
                plain_row(film, first, scale, out);
                break;
            case View::srgb:
                curved_row<identity>(film, first, y, scale, out);
                break;
            case View::reinhard:
                curved_row<reinhard>(film, first, y, scale, out);
                break;
            case View::aces:
                curved_row<aces>(film, first, y, scale, out);
                break;
            case View::neutral:
                curved_row<neutral>(film, first, y, scale, out);
                break;
            }
        }
    });
    return picture;
}

} // namespace lanecast
