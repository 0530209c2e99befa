#include "render/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace lanecast {
namespace {

using Colour = std::array<double, 3>;
using Plane = std::vector<float>;

// Linear sRGB to CIE XYZ under D65 and back; white is (0.95043, 1, 1.0889).
constexpr double xyz_from_rgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                       {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                       {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double rgb_from_xyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                       {-0.969224334, 1.875930071, 0.041554224},
                                       {0.055639423, -0.204011202, 1.057148933}};

[[nodiscard]] constexpr Colour times(const double (&m)[3][3], const Colour& c) {
    return {m[0][0] * c[0] + m[0][1] * c[1] + m[0][2] * c[2], m[1][0] * c[0] + m[1][1] * c[1] + m[1][2] * c[2],
            m[2][0] * c[0] + m[2][1] * c[1] + m[2][2] * c[2]};
}

constexpr Colour white = times(xyz_from_rgb, {1, 1, 1});

/// XYZ over white's.
[[nodiscard]] Colour relative_xyz(const Colour& rgb) {
    const Colour xyz = times(xyz_from_rgb, rgb);
    return {xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]};
}

/// A linearised L*a*b*: one achromatic and two opponent channels, in which light adds up.
[[nodiscard]] Colour opponent(const Colour& rgb) {
    const Colour r = relative_xyz(rgb);
    return {116 * r[1] - 16, 500 * (r[0] - r[1]), 200 * (r[1] - r[2])};
}

[[nodiscard]] Colour rgb_from_opponent(const Colour& c) {
    const double y = (c[0] + 16) / 116;
    const Colour rgb = times(rgb_from_xyz, {(y + c[1] / 500) * white[0], y * white[1], (y - c[2] / 200) * white[2]});
    return {std::clamp(rgb[0], 0.0, 1.0), std::clamp(rgb[1], 0.0, 1.0), std::clamp(rgb[2], 0.0, 1.0)};
}

/// L*a*b* with colour differences weighed by the light there (the Hunt effect).
[[nodiscard]] Colour adjusted_lab(const Colour& rgb) {
    constexpr double d = 6.0 / 29;
    const auto f = [](double t) { return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29; };
    const Colour r = relative_xyz(rgb);
    const double y = f(r[1]), l = 116 * y - 16;
    return {l, 0.01 * l * 500 * (f(r[0]) - y), 0.01 * l * 200 * (y - f(r[2]))};
}

/// Euclidean in colour, city-block with lightness: fits large differences better.
[[nodiscard]] double hyab(const Colour& a, const Colour& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

[[nodiscard]] double linear_of(float value, PixelValues values) {
    const double c = value > 0.0f ? std::min(static_cast<double>(value), 1.0) : 0.0; // a NaN is not
    if (values == PixelValues::linear) return c;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// Weights at -radius .. radius.
using Taps = std::vector<double>;

template <class Weight>
[[nodiscard]] Taps make_taps(int radius, const Weight& weight) {
    Taps taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(weight(static_cast<double>(i)));
    return taps;
}

/// Positive weights sum to 1, negative ones to -1, so that a feature's strength does not depend on the distance.
void normalise_by_sign(Taps& taps) {
    double positive = 0, negative = 0;
    for (const double w : taps) (w > 0 ? positive : negative) += w;
    for (double& w : taps) w /= w > 0 ? positive : negative < 0 ? -negative : 1;
}

/// The plane filtered along x with `along_x`, then along y.
[[nodiscard]] Plane filtered(const Plane& plane, int width, int height, const Taps& along_x, const Taps& along_y) {
    const int radius = static_cast<int>(along_x.size() / 2);
    const auto row = static_cast<std::size_t>(width);
    Plane middle(plane.size()), out(plane.size());
    std::vector<double> padded(row + 2 * static_cast<std::size_t>(radius)), sum(row);
    for (int y = 0; y < height; ++y) {
        const float* const from = plane.data() + static_cast<std::size_t>(y) * row;
        for (std::size_t i = 0; i < padded.size(); ++i)
            padded[i] = static_cast<double>(from[std::clamp(static_cast<int>(i) - radius, 0, width - 1)]);
        std::fill(sum.begin(), sum.end(), 0.0);
        for (std::size_t k = 0; k < along_x.size(); ++k)
            for (std::size_t x = 0; x < row; ++x) sum[x] += along_x[k] * padded[x + k];
        for (std::size_t x = 0; x < row; ++x) middle[static_cast<std::size_t>(y) * row + x] = static_cast<float>(sum[x]);
    }
    for (int y = 0; y < height; ++y) {
        std::fill(sum.begin(), sum.end(), 0.0);
        for (std::size_t k = 0; k < along_y.size(); ++k) {
            const int from_row = std::clamp(y + static_cast<int>(k) - radius, 0, height - 1);
            const float* const from = middle.data() + static_cast<std::size_t>(from_row) * row;
            for (std::size_t x = 0; x < row; ++x) sum[x] += along_y[k] * static_cast<double>(from[x]);
        }
        for (std::size_t x = 0; x < row; ++x) out[static_cast<std::size_t>(y) * row + x] = static_cast<float>(sum[x]);
    }
    return out;
}

/// Contrast sensitivity of a channel: a sum of two Gaussians over frequencies, here as filters over degrees (table 1).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity sensitivities[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
constexpr double widest = 0.04; ///< of the b

[[nodiscard]] Plane by_contrast(const Plane& plane, int width, int height, const Sensitivity& s, double ppd) {
    constexpr double pi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * ppd));
    const auto gauss = [&](double b) {
        return make_taps(radius, [&](double i) { return std::exp(-pi * pi * (i / ppd) * (i / ppd) / b); });
    };
    const auto sum = [](const Taps& taps) {
        double total = 0;
        for (const double w : taps) total += w;
        return total;
    };
    const Taps first = gauss(s.b1), second = gauss(s.b2);
    const double weight1 = s.a1 * std::sqrt(pi / s.b1), weight2 = s.a2 * std::sqrt(pi / s.b2);
    const double total = weight1 * sum(first) * sum(first) + weight2 * sum(second) * sum(second);
    Plane out = filtered(plane, width, height, first, first);
    const Plane narrow = s.a2 > 0 ? filtered(plane, width, height, second, second) : Plane(plane.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<float>((weight1 * static_cast<double>(out[i]) + weight2 * static_cast<double>(narrow[i])) / total);
    return out;
}

/// Lengths of the gradient (order 1: edges) or of the second derivatives (order 2: points) of the lightness.
[[nodiscard]] Plane features(const Plane& lightness, int width, int height, int order, double ppd) {
    constexpr double feature_width = 0.082; // degrees
    const double sigma = 0.5 * feature_width * ppd;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    const auto gauss = [&](double i) { return std::exp(-i * i / (2 * sigma * sigma)); };
    Taps smooth = make_taps(radius, gauss);
    Taps derive = make_taps(radius, [&](double i) { return (order == 1 ? -i : i * i / (sigma * sigma) - 1) * gauss(i); });
    normalise_by_sign(smooth);
    normalise_by_sign(derive);
    const Plane x = filtered(lightness, width, height, derive, smooth), y = filtered(lightness, width, height, smooth, derive);
    Plane length(x.size());
    for (std::size_t i = 0; i < length.size(); ++i) length[i] = std::hypot(x[i], y[i]);
    return length;
}

/// Of a colour difference, to 0..1: small ones get most of the range.
[[nodiscard]] double redistributed(double difference) {
    constexpr double qc = 0.7, pc = 0.4, pt = 0.95;
    static const double largest = std::pow(hyab(adjusted_lab({0, 1, 0}), adjusted_lab({0, 0, 1})), qc);
    const double d = std::pow(difference, qc), knee = pc * largest;
    return d < knee ? pt / knee * d : pt + (d - knee) / (largest - knee) * (1 - pt);
}

} // namespace

SeenPicture see(const Film& film, PixelValues values, double pixels_per_degree) {
    SeenPicture seen;
    seen.width = film.width;
    seen.height = film.height;
    const std::size_t count = film.rgb[0].size();
    Plane channels[3] = {Plane(count), Plane(count), Plane(count)}, lightness(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Colour c =
            opponent({linear_of(film.rgb[0][i], values), linear_of(film.rgb[1][i], values), linear_of(film.rgb[2][i], values)});
        for (std::size_t k = 0; k < 3; ++k) channels[k][i] = static_cast<float>(c[k]);
        lightness[i] = static_cast<float>((c[0] + 16) / 116);
    }
    if (count == 0) return seen;
    seen.edge = features(lightness, film.width, film.height, 1, pixels_per_degree);
    seen.point = features(lightness, film.width, film.height, 2, pixels_per_degree);
    for (std::size_t k = 0; k < 3; ++k)
        channels[k] = by_contrast(channels[k], film.width, film.height, sensitivities[k], pixels_per_degree);
    for (Plane& plane : seen.lab) plane.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Colour lab = adjusted_lab(rgb_from_opponent(
            {static_cast<double>(channels[0][i]), static_cast<double>(channels[1][i]), static_cast<double>(channels[2][i])}));
        for (std::size_t k = 0; k < 3; ++k) seen.lab[k][i] = static_cast<float>(lab[k]);
    }
    return seen;
}

std::vector<float> flip_map(const SeenPicture& a, const SeenPicture& b) {
    std::vector<float> map(a.edge.size());
    const auto lab = [](const SeenPicture& p, std::size_t i) {
        return Colour{static_cast<double>(p.lab[0][i]), static_cast<double>(p.lab[1][i]), static_cast<double>(p.lab[2][i])};
    };
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double colour = redistributed(hyab(lab(a, i), lab(b, i)));
        const double feature = static_cast<double>(std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i])));
        map[i] = static_cast<float>(std::pow(colour, 1 - std::sqrt(feature / std::numbers::sqrt2)));
    }
    return map;
}

double mean_flip(const SeenPicture& a, const SeenPicture& b) {
    const std::vector<float> map = flip_map(a, b);
    double sum = 0;
    for (const float value : map) sum += static_cast<double>(value);
    return map.empty() ? 0 : sum / static_cast<double>(map.size());
}

} // namespace lanecast
