#pragma once
// The sRGB transfer curve (IEC 61966-2-1), exact to 1/64 of an 8-bit code, without the library's pow: its last bits differ
// between machines, and pictures must not.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lanecast {

inline constexpr int srgb_steps_per_code = 64;
inline constexpr int srgb_steps = 255 * srgb_steps_per_code;

/// Look up with steps_of.
struct SrgbCurve {
    std::vector<float> threshold;           ///< [q]: the smallest float that maps to q; q = 0 to srgb_steps, then infinity
    std::vector<std::uint16_t> first_steps; ///< [bucket]: how many thresholds, but for that of 0, lie in lower buckets
};

/// Built at first use, in a quarter of a millisecond.
[[nodiscard]] const SrgbCurve& srgb_curve();

/// By the root, which is nearly the curve: so narrow in values that each bucket holds one threshold at most, as the test checks.
inline constexpr int srgb_buckets = 32768;
[[nodiscard]] inline int srgb_bucket(float value) noexcept {
    return static_cast<int>(std::sqrt(value) * static_cast<float>(srgb_buckets - 1));
}

/// round(srgb_steps * srgb(value)), 0 <= value <= 1. `bucket`: of this value.
[[nodiscard]] inline int steps_of(const SrgbCurve& curve, float value, int bucket) noexcept {
    const std::size_t q = curve.first_steps[static_cast<std::size_t>(bucket)];
    return static_cast<int>(q) + (value >= curve.threshold[q + 1] ? 1 : 0);
}

} // namespace lanecast
