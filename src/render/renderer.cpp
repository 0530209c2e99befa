#include "render/renderer.hpp"

#include "render/camera.hpp"
#include "scene/aligned_bytes.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace lanecast {
namespace {

/// An empty crop is the whole image.
Tile rendered_part(const FrameOptions& options) {
    const Tile& crop = options.crop;
    return crop.x1 <= crop.x0 || crop.y1 <= crop.y0 ? Tile{0, 0, options.width, options.height} : crop;
}

using Clock = std::chrono::steady_clock;

AntiAliasKind anti_alias_kind(AntiAliasMode mode) {
    switch (mode) {
    case AntiAliasMode::cross:
        return AntiAliasKind::cross;
    case AntiAliasMode::grid:
        return AntiAliasKind::grid;
    case AntiAliasMode::edge:
        return AntiAliasKind::edge;
    case AntiAliasMode::off:
        break;
    }
    return AntiAliasKind::off;
}

} // namespace

std::uint64_t ray_count(const TileStats& stats) noexcept {
    std::uint64_t rays = 0;
    for (const RayKindStats& kind : stats.kinds) rays += kind.rays;
    return rays;
}

void add(TileStats& sum, const TileStats& tile) noexcept {
    for (int kind = 0; kind < ray_kind_count; ++kind) {
        RayKindStats& to = sum.kinds[kind];
        const RayKindStats& from = tile.kinds[kind];
        to.rays += from.rays;
        to.batches += from.batches;
        to.first_lanes += from.first_lanes;
        to.first_active += from.first_active;
        to.last_lanes += from.last_lanes;
        to.last_active += from.last_active;
        to.ticks += from.ticks;
    }
    sum.total_ticks += tile.total_ticks;
}

// Edge traces a border of two pixels around a tile, too.
PixelOrder pixel_order(const RenderSettings& settings, const FrameOptions& options) {
    return morton_order(options.tile_size + (settings.anti_aliasing.mode == AntiAliasMode::edge ? 4 : 0));
}

RenderJob make_job(const SceneArrays& scene, const Camera& camera, const RenderSettings& settings, const FrameOptions& options) {
    RenderJob job{};
    job.scene = view(scene);
    job.camera = make_camera(camera, scene.normalisation, options.width, options.height);
    job.image_width = options.width;
    job.image_height = options.height;
    job.tile_size = options.tile_size;
    job.depth = settings.depth;
    job.cutoff = static_cast<float>(settings.cutoff);
    job.shadows = settings.shadows ? 1 : 0;
    job.transmissive_shadows = settings.transmissive_shadows && (scene.features & feature_transmissive) != 0 ? 1 : 0;
    job.schlick = settings.schlick ? 1 : 0;
    job.brute_force = settings.bvh == BvhMode::off ? 1 : 0;
    job.soft_samples = (scene.features & feature_soft_lights) != 0 ? settings.soft_shadows : 0;
    job.anti_alias = anti_alias_kind(settings.anti_aliasing.mode);
    job.samples = settings.anti_aliasing.samples;
    job.offset = static_cast<float>(settings.anti_aliasing.offset);
    job.offset_planes = settings.anti_aliasing.planes ? 1 : 0;
    return job;
}

int default_tile_size(const FrameOptions& options) {
    return TileGrid(rendered_part(options), 64).count() >= 16u * static_cast<unsigned>(std::max(options.threads, 1)) ? 64 : 32;
}

Frame render_frame(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera, const RenderSettings& settings,
                   const FrameOptions& options, const Progress& progress) {
    const Tile crop = rendered_part(options);
    Frame frame;
    frame.film = make_film(options.width, options.height, crop);
    RenderJob job = make_job(scene, camera, settings, options);
    job.film = view(frame.film);
    static_assert(sizeof(std::atomic<bool>) == sizeof(bool) && std::atomic<bool>::is_always_lock_free);
    job.stop = reinterpret_cast<const bool*>(options.stop); // kernels include no header with functions
    const PixelOrder order = pixel_order(settings, options);
    job.pixel_order[0] = order.x.data();
    job.pixel_order[1] = order.y.data();
    job.pixel_order_count = order.count;

    const TileGrid tiles(crop, options.tile_size);
    int threads =
        static_cast<int>(std::clamp<std::size_t>(tiles.count(), 1, static_cast<std::size_t>(std::max(options.threads, 1))));
    const std::uint64_t scratch_bytes = kernels.scratch_bytes(job);
    std::vector<AlignedBytes> scratch; // untouched pages cost nothing: levels that are never reached take address space only
    for (int i = 0; i < threads; ++i) scratch.push_back(make_aligned_bytes(scratch_bytes));

    std::atomic<std::size_t> next{0}, done{0};
    std::atomic<std::uint64_t> rays{0};
    std::mutex mutex; // of frame.stats and `finished`; taken once per worker
    std::condition_variable all_done;
    int finished = 0;
    const auto stopped = [&] { return options.stop != nullptr && options.stop->load(std::memory_order_relaxed); };
    const auto work = [&](int worker) {
        TileStats sum{};
        for (std::size_t i = next.fetch_add(1, std::memory_order_relaxed); i < tiles.count() && !stopped();
             i = next.fetch_add(1, std::memory_order_relaxed)) {
            const TileStats tile = kernels.render_tile(job, tiles.at(i), scratch[static_cast<std::size_t>(worker)].get());
            if (stopped()) break; // perhaps within the tile
            add(sum, tile);
            done.fetch_add(1, std::memory_order_relaxed);
            rays.fetch_add(ray_count(tile), std::memory_order_relaxed);
        }
        const std::lock_guard lock(mutex);
        add(frame.stats.tiles, sum);
        ++finished;
        all_done.notify_one();
    };

    const auto begin = Clock::now();
    const std::uint64_t begin_ticks = __builtin_ia32_rdtsc();
    {
        std::vector<std::jthread> workers;
        // without progress the caller is a worker too: one thread less to start
        try {
            for (int i = progress ? 0 : 1; i < threads; ++i) workers.emplace_back(work, i);
        } catch (const std::system_error&) { // the machine has no more threads: those that started do the work
            threads = static_cast<int>(workers.size()) + (progress ? 0 : 1);
            if (threads == 0) throw;
        }
        if (progress) {
            std::unique_lock lock(mutex);
            while (!all_done.wait_for(lock, std::chrono::milliseconds(100), [&] { return finished == threads; })) {
                lock.unlock();
                progress(static_cast<double>(done.load()) / static_cast<double>(tiles.count()), rays.load());
                lock.lock();
            }
        } else {
            work(0);
        }
    }
    frame.stats.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    frame.stats.ticks_per_second = static_cast<double>(__builtin_ia32_rdtsc() - begin_ticks) / frame.stats.seconds;
    frame.stats.threads = threads;
    frame.complete = done.load() == tiles.count();
    return frame;
}

} // namespace lanecast
