#pragma once
// How far two pictures are from each other.

#include "render/film.hpp"

#include <cstdint>

namespace lanecast {

/// A pixel is off when a channel differs by more. For 8-bit pictures: by more than one code.
inline constexpr double default_off_threshold = 1.0 / 255;

/// Over the pixels both films hold. Equal values differ by 0, equal infinities too; a NaN, and an infinity that is not in both,
/// differ infinitely from anything.
struct Comparison {
    bool same_size = false;                                ///< of the images; if not, nothing was compared
    bool same_window = false;                              ///< the films hold the same pixels of the image
    bool identical = false;                                ///< size, window and every bit: also +0 and -0 differ
    std::uint64_t pixels = 0;                              ///< compared
    double rmse = 0;                                       ///< root of the mean square over pixels and channels
    double relmse = 0;                                     ///< mean of (a - b)^2 / (b^2 + 1/100): b is the reference
    double largest = 0;                                    ///< difference of a channel
    int largest_x = 0, largest_y = 0, largest_channel = 0; ///< the first such pixel, in the image; meaningful if largest > 0
    float largest_a = 0, largest_b = 0;                    ///< the values there
    std::uint64_t off_pixels = 0;
};

[[nodiscard]] Comparison compare(const Film& a, const Film& b, double off_threshold = default_off_threshold) noexcept;

/// Of the pixels compared; 0 of none.
[[nodiscard]] double off_share(const Comparison& comparison) noexcept;

/// scale * |a - b|, of the pixels both films hold, infinite where the difference is. The films' image sizes are equal.
[[nodiscard]] Film difference_picture(const Film& a, const Film& b, float scale);

} // namespace lanecast
