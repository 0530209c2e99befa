#pragma once
// Float to IEEE half, written so that a baseline compiler vectorises a loop of it. Imath's does not, and its F16C form
// depends on the flags it is compiled with; the test compares every kind of value with Imath's.

#include <bit>
#include <cstdint>

namespace lanecast {

inline constexpr float largest_half = 65504.0f;

/// Round to nearest even. `value` is finite and |value| <= largest_half.
/// After F. Giesen, float_to_half_fast3_rtne (2012).
[[nodiscard]] inline std::uint16_t half_bits(float value) noexcept {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    // Below the smallest normal half, 2^-14: adding 1/2 puts the half's last place, 2^-24, at the float's, and the addition
    // rounds.
    const float half = 0.5f;
    const std::uint32_t subnormal =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + half) - std::bit_cast<std::uint32_t>(half);
    // Else: move the exponent's bias from 127 to 15, add just under half a unit of the last place kept, and one more if it is
    // odd.
    const std::uint32_t normal = (magnitude - (112u << 23) + 0xfffu + ((magnitude >> 13) & 1u)) >> 13;
    return static_cast<std::uint16_t>((bits >> 16 & 0x8000u) | (magnitude < (113u << 23) ? subnormal : normal));
}

/// The half as a float again: what a file of halves gives back. The same conditions.
[[nodiscard]] inline float rounded_to_half(float value) noexcept {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    const float subnormal = (std::bit_cast<float>(magnitude) + 0.5f) - 0.5f;
    const std::uint32_t normal = (magnitude + 0xfffu + ((magnitude >> 13) & 1u)) & ~0x1fffu;
    const std::uint32_t rounded = magnitude < (113u << 23) ? std::bit_cast<std::uint32_t>(subnormal) : normal;
    return std::bit_cast<float>(rounded | (bits & 0x80000000u));
}

} // namespace lanecast
