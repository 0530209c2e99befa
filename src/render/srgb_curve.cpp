#include "render/srgb_curve.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lanecast {
namespace {

constexpr int mantissa_bits = 11; // of the bucket index: at most two steps per bucket, mostly none
constexpr int bucket_shift = 23 - mantissa_bits;
constexpr std::uint32_t first_bits = (127u - 19) << 23; // 2^-19; smaller values map to 0, see the static_assert
constexpr std::uint32_t one_bits = 127u << 23;
static_assert(12.92 * srgb_steps / 524288 < 0.5);

/// Inverse of the curve. `guess` > 0 is near the result's fifth root of the squared base; it is refined and kept for the next.
[[nodiscard]] double linear_from_srgb(double encoded, double& guess) {
    if (encoded <= 0.04045) return encoded / 12.92;
    // x^2.4 = x^2 * r, r = (x^2)^(1/5), by Newton's method in IEEE operations: neighbours' roots are so near that
    // three steps reach the last bit or the one before.
    const double x = (encoded + 0.055) / 1.055, square = x * x;
    double r = guess;
    for (int i = 0; i < 3; ++i) r -= (r - square / (r * r * r * r)) / 5;
    guess = r;
    return square * r;
}

} // namespace

SrgbCurve::SrgbCurve() {
    threshold_.resize(srgb_steps + 2);
    threshold_[0] = -std::numeric_limits<float>::infinity();
    double root = 0.36; // at the curve's start: ((0.04045 + 0.055) / 1.055)^(2/5) = 0.3825
    for (int q = 1; q <= srgb_steps; ++q) {
        const double edge = linear_from_srgb((q - 0.5) / srgb_steps, root);
        float threshold = static_cast<float>(edge);
        if (threshold < edge) threshold = std::nextafter(threshold, 2.0f);
        threshold_[static_cast<std::size_t>(q)] = threshold;
    }
    threshold_.back() = std::numeric_limits<float>::infinity();

    steps_of_bits_.resize(((one_bits - first_bits) >> bucket_shift) + 1);
    std::uint16_t q = 0;
    for (std::size_t i = 0; i < steps_of_bits_.size(); ++i) {
        const float value = std::bit_cast<float>(first_bits + (static_cast<std::uint32_t>(i) << bucket_shift));
        while (value >= threshold_[q + std::size_t{1}]) ++q;
        steps_of_bits_[i] = q;
    }
}

int SrgbCurve::steps(float value) const noexcept {
    if (!(value < 1.0f)) return srgb_steps;
    const std::int32_t bits = std::bit_cast<std::int32_t>(value); // negative for negative values
    if (bits < static_cast<std::int32_t>(first_bits)) return 0;
    std::size_t q = steps_of_bits_[(static_cast<std::uint32_t>(bits) - first_bits) >> bucket_shift];
    while (value >= threshold_[q + 1]) ++q;
    return static_cast<int>(q);
}

const SrgbCurve& srgb_curve() {
    static const SrgbCurve curve;
    return curve;
}

} // namespace lanecast
