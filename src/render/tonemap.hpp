#pragma once
// From the film's radiance to the 8-bit picture of one view. Formulae and sources: docs/output.md.

#include "render/film.hpp"
#include "render/png_io.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace lanecast {

enum class View {
    plain,    ///< linear values, clamped and rounded: no curve, no dithering
    srgb,     ///< clamped, then the sRGB curve
    reinhard, ///< c / (1 + c) per channel (Reinhard et al. 2002, eq. 3), then the curve
    aces,     ///< Narkowicz's 2015 fit of the ACES filmic curve per channel, then the sRGB curve
    neutral,  ///< Khronos PBR Neutral (2024), then the sRGB curve
};

inline constexpr std::array<std::string_view, 5> view_names = {"plain", "srgb", "reinhard", "aces", "neutral"};

/// srgb, since a typed colour in [0, 1] arrives on the screen as exactly that colour: a background of 0.5 is half the screen's
/// light, white is white. neutral subtracts up to 0.04 for a Fresnel reflection that Whitted's model does not add, and
/// compresses from 0.76 on, so that white becomes a light grey; it is the better choice where lights add up to far more than 1.
inline constexpr View default_view = View::srgb;

[[nodiscard]] std::optional<View> view_from_name(std::string_view name) noexcept;

/// The film times 2^exposure in this view. All but plain are dithered by a fixed mask that is laid on the whole image, so a
/// crop's bytes are those of the whole image there. NaN shows as black. IEEE operations only: the same bytes on every machine.
[[nodiscard]] Picture8 tonemap(const Film& film, View view, double exposure = 0, int threads = 1);

} // namespace lanecast
