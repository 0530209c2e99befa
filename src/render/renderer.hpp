#pragma once
// A frame: tiles on std::jthread workers.

#include "render/film.hpp"
#include "render/kernel_table.hpp"
#include "render/tiles.hpp"
#include "scene/render_settings.hpp"
#include "scene/scene_arrays.hpp"

#include <atomic>
#include <functional>

namespace lanecast {

struct FrameOptions {
    int width = 512, height = 512; ///< of the image, in pixels
    Tile crop{0, 0, 0, 0};         ///< part of the image to render; empty: all of it
    int threads = 1;
    int tile_size = 32;                      ///< pixels, 1 to 64; tiles lie on the absolute pixel grid
    const std::atomic<bool>* stop = nullptr; ///< once true no more is traced; may be null
};

/// 64 where every thread gets 16 such tiles or more, else 32: `edge` traces a border of two pixels around each, which is 27 %
/// more centres for tiles of 32 and 13 % for those of 64.
[[nodiscard]] int default_tile_size(const FrameOptions& options);

/// Of all kinds.
[[nodiscard]] std::uint64_t ray_count(const TileStats& stats) noexcept;
void add(TileStats& sum, const TileStats& tile) noexcept;

struct FrameStats {
    TileStats tiles{}; ///< summed over tiles and threads
    int threads = 0;
    double seconds = 0;          ///< first ray to finished film
    double ticks_per_second = 0; ///< of the time-stamp counter, measured over the frame
};

struct Frame {
    Film film;
    FrameStats stats;
    bool complete = false; ///< false: stopped before every tile was rendered
};

/// Called from the calling thread, about ten times a second: share of the tiles done, 0 to 1, rays traced so far.
using Progress = std::function<void(double done, std::uint64_t rays)>;

/// The job a frame's kernels get, without its film.
[[nodiscard]] RenderJob make_job(const SceneArrays& scene, const Camera& camera, const RenderSettings& settings,
                                 const FrameOptions& options);

/// In which order the kernels take the pixels of a tile: RenderJob::pixel_order.
[[nodiscard]] PixelOrder pixel_order(const RenderSettings& settings, const FrameOptions& options);

/// Throws std::bad_alloc.
[[nodiscard]] Frame render_frame(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera,
                                 const RenderSettings& settings, const FrameOptions& options, const Progress& progress = {});

} // namespace lanecast
