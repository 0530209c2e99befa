#pragma once
// No NaN and no infinity leaves the program: what a fault in the renderer or an overflow of a bright scene leaves in the film is
// replaced and counted, and the caller tells the user.

#include "render/film.hpp"

#include <cstdint>

namespace lanecast {

/// Values (not pixels) that are NaN or infinite.
[[nodiscard]] std::uint64_t count_not_finite(const Film& film) noexcept;

/// NaN becomes 0, an infinity the largest float of its sign.
[[nodiscard]] float scrubbed(float value) noexcept;

/// The whole film. Returns how many values were replaced.
std::uint64_t scrub(Film& film) noexcept;

/// Finite values outside the range of half, +-65504: a half file clamps them.
[[nodiscard]] std::uint64_t count_beyond_half(const Film& film) noexcept;

} // namespace lanecast
