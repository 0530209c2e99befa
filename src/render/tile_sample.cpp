#include "render/tile_sample.hpp"

#include "scene/aligned_bytes.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>
#include <numeric>

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
    sample.frame_pixels = pixels_of(frame);
    return sample;
}

/// Of this thread, in seconds.
[[nodiscard]] double processor_time() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

[[nodiscard]] PixelOrder sparse_order(int side, int stride) {
    PixelOrder order = morton_order((side + stride - 1) / stride);
    for (std::int32_t& x : order.x) x *= stride;
    for (std::int32_t& y : order.y) y *= stride;
    return order;
}

/// The curve of morton_order: coordinates differ in some highest bit, and the larger of these decides (Chan 2002).
[[nodiscard]] bool morton_less(const Tile& a, const Tile& b) {
    const auto x = static_cast<std::uint32_t>(a.x0 ^ b.x0), y = static_cast<std::uint32_t>(a.y0 ^ b.y0);
    return std::bit_floor(x) > std::bit_floor(y) ? a.x0 < b.x0 : a.y0 < b.y0;
}

/// By drawn tile: the inverse of its chance, corrected so that the weighted pixels of the uncertain tiles are those there are,
/// and their weighted chances, too: then errors that are even and errors that are in proportion to the importance are both told
/// exactly (Deville and Saerndal, Calibration Estimators in Survey Sampling, 1992).
[[nodiscard]] std::vector<double> calibrated_weights(const TileSample& sample, const std::vector<double>& chance,
                                                     const std::vector<std::size_t>& drawn) {
    double pixels = 0, chances = 0; // of the uncertain ones: what the drawn ones lack
    for (std::size_t i = 0; i < chance.size(); ++i) {
        if (chance[i] >= 1) continue;
        pixels += pixels_of(sample.tiles[i]);
        chances += pixels_of(sample.tiles[i]) * chance[i];
    }
    double sum = 0, linear = 0, square = 0;
    for (const std::size_t i : drawn) {
        if (chance[i] >= 1) continue;
        const double weighted = pixels_of(sample.tiles[i]) / chance[i];
        sum += weighted;
        linear += weighted * chance[i];
        square += weighted * chance[i] * chance[i];
    }
    const double determinant = sum * square - linear * linear;
    double constant = pixels / sum, slope = 0; // of the correction, over the chance
    if (determinant > 1e-6 * sum * square) {
        constant = (pixels * square - chances * linear) / determinant;
        slope = (chances * sum - pixels * linear) / determinant;
    }
    const bool usable = std::ranges::all_of(drawn, [&](std::size_t i) { return constant + slope * chance[i] > 0.1; });
    if (!usable) constant = pixels / sum, slope = 0;
    std::vector<double> weights;
    for (const std::size_t i : drawn) weights.push_back(chance[i] >= 1 ? 1 : (constant + slope * chance[i]) / chance[i]);
    return weights;
}

} // namespace

TileSample every_tile(const FrameOptions& options) {
    TileSample sample = empty_sample(options);
    const TileGrid grid(frame_of(options), options.tile_size);
    sample.windows = {frame_of(options)};
    for (std::size_t i = 0; i < grid.count(); ++i) sample.tiles.push_back(grid.at(i));
    sample.window_of.assign(sample.tiles.size(), 0);
    sample.weights = {1};
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
    for (const std::size_t tile : chosen) sample.tiles.push_back(grid.at(tile));
    return each_alone(std::move(sample));
}

TileSample each_alone(TileSample sample) {
    sample.windows = sample.tiles;
    sample.window_of.resize(sample.tiles.size());
    std::iota(sample.window_of.begin(), sample.window_of.end(), std::uint32_t{0});
    sample.weights.assign(sample.tiles.size(), sample.frame_pixels / sample.pixels());
    return sample;
}

std::vector<double> chances_of(const std::vector<double>& importance, std::size_t count) {
    std::vector<double> chance(importance.size(), 0);
    count = std::min(count, chance.size());
    std::size_t certain = 0;
    for (bool more = true; more;) { // what is left by the certain ones is shared by the others
        more = false;
        double rest = 0;
        for (std::size_t i = 0; i < chance.size(); ++i)
            if (chance[i] < 1) rest += importance[i];
        const double step = rest / static_cast<double>(count - certain);
        for (std::size_t i = 0; i < chance.size(); ++i) {
            if (chance[i] >= 1) continue;
            chance[i] = std::min(importance[i] / step, 1.0);
            if (chance[i] < 1) continue;
            ++certain;
            more = true;
        }
    }
    return chance;
}

TileSample draw_tiles(const TileSample& sample, const std::vector<double>& chance) {
    std::vector<std::size_t> order(sample.tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return morton_less(sample.tiles[a], sample.tiles[b]); });
    std::vector<std::size_t> drawn;
    double sum = 0.5;
    for (const std::size_t i : order) {
        const double before = sum;
        if (chance[i] < 1) sum += chance[i];
        if (chance[i] >= 1 || std::floor(sum) != std::floor(before)) drawn.push_back(i);
    }
    TileSample out = sample;
    out.stride = 1;
    out.tiles.clear();
    for (const std::size_t i : drawn) out.tiles.push_back(sample.tiles[i]);
    out = each_alone(std::move(out));
    out.weights = calibrated_weights(sample, chance, drawn);
    const double scale = sample.frame_pixels / sample.pixels();
    for (double& weight : out.weights) weight *= scale;
    return out;
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
    rendered.tile_rays.resize(sample.tiles.size());
    FrameOptions same = options;
    same.width = sample.width;
    same.height = sample.height;
    same.tile_size = sample.tile_size;
    const RenderJob whole = make_job(scene, camera, settings, same);
    const PixelOrder order = sample.stride == 1 ? pixel_order(settings, same) : sparse_order(sample.tile_size, sample.stride);
    const int threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(options.threads), sample.tiles.size()));

    std::atomic<std::size_t> next{0};
    std::mutex mutex; // of rendered's stats and times
    parallel_for(threads, static_cast<std::size_t>(threads), [&](std::size_t) {
        RenderJob job = whole;
        job.pixel_order[0] = order.x.data();
        job.pixel_order[1] = order.y.data();
        job.pixel_order_count = order.count;
        const AlignedBytes scratch = make_aligned_bytes(kernels.scratch_bytes(job));
        TileStats stats{};
        double seconds = 0, frame_seconds = 0, frame_rays = 0;
        for (std::size_t i = next.fetch_add(1); i < sample.tiles.size(); i = next.fetch_add(1)) {
            job.film = view(rendered.films[sample.window_of[i]]);
            const double begin = processor_time();
            const TileStats tile = kernels.render_tile(job, sample.tiles[i], scratch.get());
            const double spent = processor_time() - begin, weight = sample.weights[sample.window_of[i]];
            rendered.tile_rays[i] = static_cast<double>(ray_count(tile));
            seconds += spent;
            frame_seconds += weight * spent;
            frame_rays += weight * rendered.tile_rays[i];
            add(stats, tile);
        }
        const std::lock_guard lock(mutex);
        add(rendered.stats, stats);
        rendered.seconds += seconds;
        rendered.frame_seconds += frame_seconds;
        rendered.frame_rays += frame_rays;
    });
    return rendered;
}

} // namespace lanecast
