#pragma once
// FLIP: how different two pictures look when one is flipped against the other. Andersson, Nilsson, Akenine-Moeller, Oskarsson,
// Astroem and Fairchild, "FLIP: A Difference Evaluator for Alternating Images", HPG 2020; the form for pictures of a screen's
// range. Our own code, written from the paper.

#include "render/film.hpp"

#include <vector>

namespace lanecast {

/// The authors': a screen 0.7 m wide with 3840 pixels, seen from 0.7 m. Of the eye's field.
inline constexpr double default_pixels_per_degree = 67.02064327658226;

/// What a film's values stand for. Both are clamped to what a screen shows, 0 to 1; NaN counts as 0.
enum class PixelValues {
    linear, ///< radiance, as the view `srgb` shows it
    codes,  ///< of a PNG, over 255: the sRGB curve is undone first
};

/// A picture as the eye takes it in, made once and compared with many.
struct SeenPicture {
    int width = 0, height = 0;
    std::vector<float> lab[3];      ///< filtered by the contrast sensitivity, L*a*b*, Hunt-adjusted
    std::vector<float> edge, point; ///< lengths of the feature vectors
};

/// Beyond its border the film is continued by its outermost pixels. Throws std::bad_alloc.
[[nodiscard]] SeenPicture see(const Film& film, PixelValues values = PixelValues::linear,
                              double pixels_per_degree = default_pixels_per_degree);

/// Per pixel, row by row, 0 to 1. The pictures have the same size and were seen at the same distance.
[[nodiscard]] std::vector<float> flip_map(const SeenPicture& a, const SeenPicture& b);

/// The mean of the map, which the authors advise where one number is wanted; 0 of no pixel.
[[nodiscard]] double mean_flip(const SeenPicture& a, const SeenPicture& b);

} // namespace lanecast
