#pragma once
// A choice of settings, tried: its error against the reference picture and its time.

#include "cli/measure/knobs.hpp"
#include "render/flip.hpp"
#include "render/tile_sample.hpp"
#include "scene/description.hpp"

#include <string>
#include <vector>

namespace lanecast::trade {

/// Against a reference, of linear RGB; FLIP of what the view `srgb` shows.
struct PictureError {
    double rmse = 0, relmse = 0;
    double largest = 0;
    double off = 0;                        ///< share of the pixels in which a channel is off by more than 1/255
    double flip = 0;                       ///< mean; of a sample of tiles, each is seen alone, continued by its outermost pixels
    double rmse_above = 0, flip_above = 0; ///< what the frame's may be: two standard errors of the spread between tiles above it
};

/// Pictures of the same windows. `seen`: empty, or of the reference.
struct ReferencePicture {
    std::vector<Film> films;
    std::vector<SeenPicture> seen; ///< by window
    double frame_seconds = 0;      ///< processor time a whole frame of it would take
};

[[nodiscard]] PictureError error_of(const std::vector<Film>& films, const ReferencePicture& reference, const TileSample& sample);

/// What all trials have in common. They hold nothing that a signal could spoil, so no InterruptScope either: it ends the process.
struct Bench {
    const SceneArrays* scene = nullptr;
    const Camera* camera = nullptr;
    std::string isa = "auto";
    FrameOptions options;
    TileSample sample;
};

[[nodiscard]] RenderedSample render(const Bench& bench, const RenderSettings& settings);

/// The same pixels, but the reference's by `truth_kernels`: its times are not those of a frame.
[[nodiscard]] RenderedSample render_sooner(const Bench& bench, const RenderSettings& settings);

/// The films as the file will give them back.
void round_as_file(std::vector<Film>& films, bool float_file);

[[nodiscard]] ReferencePicture render_reference(const Bench& bench, const Choice& choice);

/// The windows of `sample` out of a reference picture whose windows hold them.
[[nodiscard]] ReferencePicture cut(const ReferencePicture& reference, const TileSample& sample);

/// Processor time of encoding a file with these pixels, scaled to the frame.
[[nodiscard]] double time_of_file(const Bench& bench, const std::vector<Film>& films, bool float_file);

/// Cheap settings that still show what depth and cutoff leave out: float, without anti-aliasing, shadows hard and black.
[[nodiscard]] RenderSettings bare(RenderSettings settings);

/// Where glass and mirrors face each other, rays are nearly without end: makes the largest depth and then the smallest cutoff the
/// truth that keep them to ten mirrored and transmitted ones per camera ray.
void bound_truth(const Bench& bench, const Choice& base, std::vector<Ladder>& ladders);

/// The truth again with two thirds of its samples per side, of its shadow rays and of its depth, four times its cutoff, in float:
/// as far as these were to be turned.
[[nodiscard]] Choice second_truth(const Choice& truth, const std::vector<Ladder>& ladders);

} // namespace lanecast::trade
