#include "render/tile_sample.hpp"

#include "scene/aligned_bytes.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include <time.h>

namespace lanecast {
namespace {

[[nodiscard]] Tile frame_of(const FrameOptions& options) {
    const Tile& crop = options.crop;
    return crop.x1 > crop.x0 && crop.y1 > crop.y0 ? crop : Tile{0, 0, options.width, options.height};
}

[[nodiscard]] TileSample empty_sample(const FrameOptions& options) {
    const Tile frame = frame_of(options);
    TileSample sample;
    sample.width = options.width;
    sample.height = options.height;
    sample.tile_size = options.tile_size;
    sample.frame_pixels = static_cast<double>(frame.x1 - frame.x0) * (frame.y1 - frame.y0);
    return sample;
}

/// Of this thread, in seconds.
[[nodiscard]] double processor_time() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace

TileSample every_tile(const FrameOptions& options) {
    TileSample sample = empty_sample(options);
    const TileGrid grid(frame_of(options), options.tile_size);
    sample.windows = {frame_of(options)};
    for (std::size_t i = 0; i < grid.count(); ++i) sample.tiles.push_back(grid.at(i));
    sample.window_of.assign(sample.tiles.size(), 0);
    return sample;
}

TileSample spread_tiles(const FrameOptions& options, std::size_t count) {
    const TileGrid grid(frame_of(options), options.tile_size);
    if (count >= grid.count()) return every_tile(options);
    // Roberts' R2 sequence: each next point falls into the largest gap; a tile met again is passed over.
    std::vector<std::size_t> chosen;
    std::vector<bool> taken(grid.count());
    for (double i = 1; chosen.size() < count; ++i) {
        const double u = std::fmod(0.5 + i * 0.7548776662466927, 1.0), v = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
        const std::size_t tile = static_cast<std::size_t>(v * grid.rows) * static_cast<std::size_t>(grid.columns) +
                                 static_cast<std::size_t>(u * grid.columns);
        if (taken[tile]) continue;
        taken[tile] = true;
        chosen.push_back(tile);
    }
    std::sort(chosen.begin(), chosen.end());
    TileSample sample = empty_sample(options);
    for (const std::size_t tile : chosen) {
        sample.window_of.push_back(static_cast<std::uint32_t>(sample.tiles.size()));
        sample.tiles.push_back(grid.at(tile));
    }
    sample.windows = sample.tiles;
    return sample;
}

TileSample in_tiles_of(const TileSample& sample, int tile_size) {
    TileSample smaller = sample;
    smaller.tile_size = std::min(sample.tile_size, tile_size);
    smaller.tiles.clear();
    smaller.window_of.clear();
    for (std::size_t i = 0; i < sample.tiles.size(); ++i) {
        const TileGrid grid(sample.tiles[i], smaller.tile_size);
        for (std::size_t k = 0; k < grid.count(); ++k) {
            smaller.tiles.push_back(grid.at(k));
            smaller.window_of.push_back(sample.window_of[i]);
        }
    }
    return smaller;
}

RenderedSample render_sample(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera,
                             const RenderSettings& settings, const FrameOptions& options, const TileSample& sample) {
    RenderedSample rendered;
    for (const Tile& window : sample.windows) rendered.films.push_back(make_film(sample.width, sample.height, window));
    FrameOptions same = options;
    same.width = sample.width;
    same.height = sample.height;
    same.tile_size = sample.tile_size;
    const RenderJob whole = make_job(scene, camera, settings, same);
    const PixelOrder order = pixel_order(settings, same);
    const int threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(options.threads), sample.tiles.size()));

    std::atomic<std::size_t> next{0};
    std::mutex mutex; // of rendered.stats and rendered.seconds
    parallel_for(threads, static_cast<std::size_t>(threads), [&](std::size_t) {
        RenderJob job = whole;
        job.pixel_order[0] = order.x.data();
        job.pixel_order[1] = order.y.data();
        job.pixel_order_count = order.count;
        const AlignedBytes scratch = make_aligned_bytes(kernels.scratch_bytes(job));
        TileStats stats{};
        double seconds = 0;
        for (std::size_t i = next.fetch_add(1); i < sample.tiles.size(); i = next.fetch_add(1)) {
            job.film = view(rendered.films[sample.window_of[i]]);
            const double begin = processor_time();
            const TileStats tile = kernels.render_tile(job, sample.tiles[i], scratch.get());
            seconds += processor_time() - begin;
            add(stats, tile);
        }
        const std::lock_guard lock(mutex);
        add(rendered.stats, stats);
        rendered.seconds += seconds;
    });
    return rendered;
}

} // namespace lanecast
