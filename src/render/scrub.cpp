#include "render/scrub.hpp"

#include "render/half_float.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace lanecast {
namespace {

// By the bits: an exponent of all ones. Immune to compiler flags that assume finite values, and vectorised.
[[nodiscard]] bool is_finite(float value) noexcept { return (std::bit_cast<std::uint32_t>(value) & 0x7f800000u) != 0x7f800000u; }

} // namespace

std::uint64_t count_not_finite(const Film& film) noexcept {
    std::uint64_t count = 0;
    for (const auto& plane : film.rgb)
        for (const float value : plane) count += is_finite(value) ? 0 : 1;
    return count;
}

float scrubbed(float value) noexcept {
    if (is_finite(value)) return value;
    return std::isnan(value) ? 0.0f : std::copysign(std::numeric_limits<float>::max(), value);
}

std::uint64_t scrub(Film& film) noexcept {
    const std::uint64_t count = count_not_finite(film);
    if (count == 0) return 0;
    for (auto& plane : film.rgb)
        for (float& value : plane) value = scrubbed(value);
    return count;
}

std::uint64_t count_beyond_half(const Film& film) noexcept {
    std::uint64_t count = 0;
    for (const auto& plane : film.rgb)
        for (const float value : plane) count += std::abs(value) > largest_half && is_finite(value) ? 1 : 0;
    return count;
}

} // namespace lanecast
