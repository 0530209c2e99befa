#include "render/srgb_curve.hpp"

#include <bit>
#include <limits>

namespace lanecast {
namespace {

/// The curve's inverse on its power, encoded > 0.04045. `root` is the fifth root below, to 2 %.
[[nodiscard]] double linear_from_srgb(double encoded, double& root) {
    // x^2.4 = x^2 * (x^2)^(1/5), the root by Newton's method in IEEE operations: 0.02, 8e-4, 1e-6, 3e-12, then the last bit or
    // the one before.
    const double x = (encoded + 0.055) / 1.055, square = x * x;
    for (int i = 0; i < 4; ++i) root -= (root - square / (root * root * root * root)) * 0.2;
    return square * root;
}

/// x > 0. The next float is the next number of bits: std::nextafter is a call.
[[nodiscard]] float rounded_up(double x) {
    const float f = static_cast<float>(x);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(f) + (static_cast<double>(f) < x ? 1u : 0u));
}

[[nodiscard]] SrgbCurve make_srgb_curve() {
    SrgbCurve curve;
    curve.threshold.resize(srgb_steps + 2);
    const auto encoded = [](int q) { return (q - 0.5) / srgb_steps; };
    int q = 1;
    for (; encoded(q) <= 0.04045; ++q) curve.threshold[static_cast<std::size_t>(q)] = rounded_up(encoded(q) / 12.92);
    // Blocks that start from one root each, not each root from the last: three times as fast, since nothing waits for a division.
    constexpr int block = 64;
    for (double start = 0.3825; q <= srgb_steps;) { // ((0.04045 + 0.055) / 1.055)^(2/5)
        double edges[block], roots[block];
        for (int i = 0; i < block; ++i) roots[i] = start, edges[i] = linear_from_srgb(encoded(q + i), roots[i]);
        for (int i = 0; i < block && q <= srgb_steps; ++i, ++q)
            curve.threshold[static_cast<std::size_t>(q)] = rounded_up(edges[i]);
        start = roots[block - 1];
    }
    curve.threshold.back() = std::numeric_limits<float>::infinity();

    curve.first_steps.resize(srgb_buckets, static_cast<std::uint16_t>(srgb_steps));
    int bucket = 0;
    for (std::size_t step = 1; step <= srgb_steps; ++step)
        for (const int last = srgb_bucket(curve.threshold[step]); bucket <= last; ++bucket)
            curve.first_steps[static_cast<std::size_t>(bucket)] = static_cast<std::uint16_t>(step - 1);
    return curve;
}

} // namespace

const SrgbCurve& srgb_curve() {
    static const SrgbCurve curve = make_srgb_curve();
    return curve;
}

} // namespace lanecast
