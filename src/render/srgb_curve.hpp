#pragma once
// The sRGB transfer curve (IEC 61966-2-1), exact to 1/64 of an 8-bit code, without the library's pow: its last bits differ
// between machines, and pictures must not.

#include <array>
#include <cstdint>
#include <vector>

namespace lanecast {

/// Maps a linear value to round(srgb_steps * srgb(value)), 0 below 0 and srgb_steps above 1.
inline constexpr int srgb_steps_per_code = 64;
inline constexpr int srgb_steps = 255 * srgb_steps_per_code;

class SrgbCurve {
public:
    SrgbCurve();
    /// `value` is not NaN.
    [[nodiscard]] int steps(float value) const noexcept;

private:
    std::vector<float> threshold_; ///< [q]: the smallest float that maps to q; q = 0 to srgb_steps, then infinity
    std::vector<std::uint16_t>
        steps_of_bits_; ///< by a value's exponent and first mantissa bits: what the smallest such value maps to
};

/// Built at first use, in well under a millisecond.
[[nodiscard]] const SrgbCurve& srgb_curve();

} // namespace lanecast
