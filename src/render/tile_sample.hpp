#pragma once
// Some tiles of a frame, or all of them, rendered and timed each on its own: the pixels are those of the whole frame, bit for
// bit, and a processor that is shared with others spoils no time.

#include "render/renderer.hpp"

#include <cstdint>
#include <vector>

namespace lanecast {

[[nodiscard]] inline double pixels_of(const Tile& t) { return static_cast<double>(t.x1 - t.x0) * (t.y1 - t.y0); }

struct TileSample {
    int width = 0, height = 0; ///< of the image, in pixels
    int tile_size = 32;
    int stride = 1;                       ///< each so many-th row and column of a tile is rendered, the rest is 0; not with edge
    std::vector<Tile> windows;            ///< of the films
    std::vector<Tile> tiles;              ///< what is rendered
    std::vector<std::uint32_t> window_of; ///< by tile
    double frame_pixels = 0;              ///< of the frame that is sampled
    std::vector<double> weights;          ///< by window: pixels of the frame that each of its pixels stands for
    [[nodiscard]] double pixels() const {
        double sum = 0;
        for (const Tile& t : tiles) sum += pixels_of(t);
        return sum;
    }
};

/// Every tile of options.crop, or of the whole image, in one film.
[[nodiscard]] TileSample every_tile(const FrameOptions& options);

/// `count` tiles spread evenly over it, each with a film of its own; all of them if there are no more.
[[nodiscard]] TileSample spread_tiles(const FrameOptions& options, std::size_t count);

/// The same tiles, each with a film of its own.
[[nodiscard]] TileSample each_alone(TileSample sample);

/// Of each tile to be one of `count` that are drawn, in proportion to `importance`, which is above 0: those that make up more
/// than a share of one in `count` are drawn for certain.
[[nodiscard]] std::vector<double> chances_of(const std::vector<double>& importance, std::size_t count);

/// Tiles of this sample, each with a film of its own, drawn with these chances: one after each equal step of their sum
/// (systematic sampling, Madow 1949), along a curve that keeps neighbours together. They are rendered whole; stride and weights
/// of the sample do not count.
[[nodiscard]] TileSample draw_tiles(const TileSample& sample, const std::vector<double>& chance);

/// The same windows in tiles of at most this size.
[[nodiscard]] TileSample in_tiles_of(const TileSample& sample, int tile_size);

struct RenderedSample {
    std::vector<Film> films;  ///< by window
    TileStats stats{};        ///< of all tiles
    double seconds = 0;       ///< processor time of the threads inside tiles
    double frame_seconds = 0; ///< of the frame, as far as the sample tells
    double frame_rays = 0;    ///< the same
    std::vector<double> tile_rays;
};

/// As `render_frame` would. options.crop and options.stop do not count. Throws std::bad_alloc.
[[nodiscard]] RenderedSample render_sample(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera,
                                           const RenderSettings& settings, const FrameOptions& options, const TileSample& sample);

} // namespace lanecast
