#include "render/pick.hpp"

#include "render/tiles.hpp"
#include "scene/aligned_bytes.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <string>

namespace lanecast {
namespace {

constexpr std::int32_t most_records = 1 << 22; // of rays: 500 MB

void check_count(std::int32_t count, const char* what) {
    if (count > most_records || count < 0)
        throw Error(ExitCode::memory, std::string("the pixel's tree has more than ") + std::to_string(most_records) + " " + what +
                                          "; a smaller depth or a cutoff makes it smaller");
}

} // namespace

PixelTrace trace_pixel(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera, const RenderSettings& settings,
                       const FrameOptions& options, int x, int y) {
    RenderJob job = make_job(scene, camera, settings, options);
    job.anti_alias = AntiAliasKind::off;
    job.tile_size = 1;
    const PixelOrder order = morton_order(1);
    job.pixel_order[0] = order.x.data();
    job.pixel_order[1] = order.y.data();
    job.pixel_order_count = order.count;
    const Tile pixel{x, y, x + 1, y + 1};
    Film film = make_film(options.width, options.height, pixel);
    job.film = view(film);
    PixelTrace trace;
    TraceLog log{
        .rays = nullptr, .lights = nullptr, .ray_capacity = 256, .light_capacity = 1024, .ray_count = 0, .light_count = 0};
    job.log = &log;
    const AlignedBytes scratch = make_aligned_bytes(kernels.scratch_bytes(job));
    for (;;) {
        trace.rays.assign(static_cast<std::size_t>(log.ray_capacity), TraceRecord{});
        trace.lights.assign(static_cast<std::size_t>(log.light_capacity), TraceLight{});
        log.rays = trace.rays.data();
        log.lights = trace.lights.data();
        log.ray_count = log.light_count = 0;
        static_cast<void>(kernels.render_tile(job, pixel, scratch.get()));
        check_count(log.ray_count, "rays");
        check_count(log.light_count, "lights of rays");
        if (log.ray_count <= log.ray_capacity && log.light_count <= log.light_capacity) break;
        log.ray_capacity = std::max(log.ray_capacity, log.ray_count);
        log.light_capacity = std::max(log.light_capacity, log.light_count);
    }
    trace.rays.resize(static_cast<std::size_t>(log.ray_count));
    trace.lights.resize(static_cast<std::size_t>(log.light_count));
    for (std::size_t c = 0; c < 3; ++c) trace.color[c] = film.rgb[c][0];
    return trace;
}

} // namespace lanecast
