#include "render/srgb_curve.hpp"

#include <limits>

namespace lanecast {
namespace {

/// The curve's inverse. `root` approximates the fifth root below; it is refined and kept for the next call, with a slightly
/// larger argument.
[[nodiscard]] double linear_from_srgb(double encoded, double& root) {
    if (encoded <= 0.04045) return encoded / 12.92;
    // x^2.4 = x^2 * (x^2)^(1/5), the root by Newton's method in IEEE operations. Arguments are so near each other that three
    // steps reach the last bit or the one before, after some more for the first.
    const double x = (encoded + 0.055) / 1.055, square = x * x;
    for (int i = 0; i < 4; ++i) root -= (root - square / (root * root * root * root)) / 5;
    return square * root;
}

[[nodiscard]] SrgbCurve make_srgb_curve() {
    SrgbCurve curve;
    curve.threshold.resize(srgb_steps + 2);
    curve.threshold[0] = 0;
    double root = 0.3825; // ((0.04045 + 0.055) / 1.055)^(2/5)
    for (int q = 1; q <= srgb_steps; ++q) {
        const double edge = linear_from_srgb((q - 0.5) / srgb_steps, root);
        float threshold = static_cast<float>(edge);
        if (static_cast<double>(threshold) < edge) threshold = std::nextafter(threshold, 2.0f);
        curve.threshold[static_cast<std::size_t>(q)] = threshold;
    }
    curve.threshold.back() = std::numeric_limits<float>::infinity();

    curve.first_steps.resize(srgb_buckets);
    std::size_t q = 0;
    for (std::size_t bucket = 0; bucket < srgb_buckets; ++bucket) {
        curve.first_steps[bucket] = static_cast<std::uint16_t>(q);
        while (q < srgb_steps && srgb_bucket(curve.threshold[q + 1]) == bucket) ++q;
    }
    return curve;
}

} // namespace

const SrgbCurve& srgb_curve() {
    static const SrgbCurve curve = make_srgb_curve();
    return curve;
}

} // namespace lanecast
