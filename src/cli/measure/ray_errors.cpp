#include "cli/measure/ray_errors.hpp"

#include "render/camera.hpp"
#include "render/dispatch.hpp"
#include "render/pick.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lanecast::trade {
namespace {

constexpr std::size_t traced_pixels = 16384; ///< whose trees give the other classes
constexpr int traced_depth = 6;
constexpr double traced_cutoff = 1.0 / 256;
constexpr float no_end = std::numeric_limits<float>::infinity();
constexpr std::int64_t tie_ulps = 4;

void add(RayList& list, const float (&org)[3], const float (&dir)[3], float tmax) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        list.org[axis].push_back(org[axis]);
        list.dir[axis].push_back(dir[axis]);
    }
    list.tmax.push_back(tmax);
}

void add_camera_ray(RayList& list, const CameraRecord& camera, float x, float y) {
    const float sx = (x - camera.half_width) * camera.pixel, sy = (camera.half_height - y) * camera.pixel;
    float dir[3];
    for (int axis = 0; axis < 3; ++axis) dir[axis] = camera.forward[axis] + sx * camera.right[axis] + sy * camera.up[axis];
    add(list, camera.org, dir, no_end);
}

/// From where a ray hit something, clear of it by a few roundings, to the middle of every light that it faces.
void add_shadow_rays(RayList& list, const SceneView& scene, const TraceRecord& hit) {
    float away = 1;
    for (const float p : hit.point) away = std::max(away, std::abs(p));
    away *= 0x1p-19f;
    for (std::uint32_t i = 0; i < scene.light_count; ++i) {
        const LightRecord& light = scene.lights[i];
        const bool directional = light.kind == LightKind::directional;
        float org[3], dir[3], facing = 0;
        for (int axis = 0; axis < 3; ++axis) {
            org[axis] = hit.point[axis] + away * hit.normal[axis];
            dir[axis] = directional ? -light.direction[axis] : light.position[axis] - org[axis];
            facing += dir[axis] * hit.normal[axis];
        }
        if (facing > 0) add(list, org, dir, directional ? no_end : 1.0f);
    }
}

/// Every n-th of the sample's pixels, so that there are about `count`.
template <class Visit>
void for_pixels(const TileSample& sample, std::size_t count, const Visit& visit) {
    const double step = std::max(1.0, sample.pixels() / static_cast<double>(count));
    double next = 0, i = 0;
    for (const Tile& tile : sample.tiles)
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x, ++i)
                if (i >= next) {
                    visit(x, y);
                    next += step;
                }
}

struct Hits {
    std::vector<float> t;
    std::vector<std::int32_t> slot;
    std::array<std::vector<float>, 3> normal;
};

[[nodiscard]] Hits trace(const KernelTable& kernels, const SceneView& scene, const RayList& rays, bool any) {
    const std::size_t n = rays.size();
    Hits hits{std::vector<float>(n), std::vector<std::int32_t>(n, -1), {}};
    RayStream stream{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stream.org[axis] = rays.org[axis].data();
        stream.dir[axis] = rays.dir[axis].data();
        if (any) continue;
        hits.normal[axis].resize(n);
        stream.normal[axis] = hits.normal[axis].data();
    }
    stream.tmax = rays.tmax.data();
    stream.slot = hits.slot.data();
    stream.count = static_cast<std::uint32_t>(n);
    if (!any) stream.t = hits.t.data();
    (any ? kernels.any_hit : kernels.closest_hit)(scene, stream);
    return hits;
}

[[nodiscard]] std::int64_t ulps(float a, float b) { // both above 0
    return std::abs(static_cast<std::int64_t>(std::bit_cast<std::int32_t>(a)) - std::bit_cast<std::int32_t>(b));
}

[[nodiscard]] double angle(const Hits& a, const Hits& b, std::size_t i) {
    double cross[3], dot = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        const auto at = [i](const Hits& hits, std::size_t axis) { return static_cast<double>(hits.normal[axis][i]); };
        cross[k] = at(a, l) * at(b, m) - at(a, m) * at(b, l);
        dot += at(a, k) * at(b, k);
    }
    return std::atan2(std::hypot(cross[0], cross[1], cross[2]), dot);
}

[[nodiscard]] double quantile(const std::vector<double>& sorted, double share) {
    return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

void set_quantiles(std::vector<double> values, double& p50, double& p99, double& max) {
    std::sort(values.begin(), values.end());
    p50 = quantile(values, 0.5), p99 = quantile(values, 0.99), max = quantile(values, 1);
}

} // namespace

const char* name_of(RayClass rays) {
    constexpr const char* names[ray_class_count] = {"camera", "shadow", "reflection", "refraction"};
    return names[static_cast<int>(rays)];
}

RayLists collect_rays(const Bench& bench, const RenderSettings& settings, std::size_t count) {
    RayLists lists;
    const CameraRecord camera = make_camera(*bench.camera, bench.scene->normalisation, bench.sample.width, bench.sample.height);
    const auto per_pixel = static_cast<std::size_t>(std::ceil(static_cast<double>(count) / bench.sample.pixels()));
    for_pixels(bench.sample, count / per_pixel, [&](int x, int y) {
        for (std::size_t s = 0; s < per_pixel; ++s) { // Roberts' R2 sequence, so that each pixel is met all over
            const double i = static_cast<double>(s) + 0.5;
            const double u = std::fmod(i * 0.7548776662466927, 1.0), v = std::fmod(i * 0.5698402909980532, 1.0);
            add_camera_ray(lists[0], camera, static_cast<float>(x + u), static_cast<float>(y + v));
        }
    });

    RenderSettings few = settings;
    few.precision = Precision::balanced;
    few.depth = std::min(settings.depth, traced_depth);
    few.cutoff = std::max(settings.cutoff, traced_cutoff);
    const KernelTable& kernels = find_kernels(bench.isa, few.precision);
    const SceneView scene = view(*bench.scene);
    FrameOptions options = bench.options;
    options.width = bench.sample.width;
    options.height = bench.sample.height;
    for_pixels(bench.sample, traced_pixels, [&](int x, int y) {
        for (const TraceRecord& ray : trace_pixel(kernels, *bench.scene, *bench.camera, few, options, x, y).rays) {
            if (ray.kind == RayKind::reflection) add(lists[2], ray.org, ray.dir, no_end);
            if (ray.kind == RayKind::refraction) add(lists[3], ray.org, ray.dir, no_end);
            if (ray.slot >= 0 && settings.shadows) add_shadow_rays(lists[1], scene, ray);
        }
    });
    return lists;
}

std::vector<RayErrors> ray_errors(const Bench& bench, const RayLists& lists, const KernelTable& kernels,
                                  const std::string& precision) {
    const KernelTable& reference = truth_kernels();
    const SceneView scene = view(*bench.scene);
    std::vector<RayErrors> rows;
    for (int k = 0; k < ray_class_count; ++k) {
        const RayList& rays = lists[static_cast<std::size_t>(k)];
        if (rays.size() == 0) continue;
        RayErrors row{.precision = precision, .isa = kernels.isa, .rays = static_cast<RayClass>(k), .count = rays.size()};
        const bool any = row.rays == RayClass::shadow;
        const Hits truth = trace(reference, scene, rays, any), hits = trace(kernels, scene, rays, any);
        std::vector<double> distances, angles;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool hit = hits.slot[i] >= 0, truly = truth.slot[i] >= 0;
            row.missed += truly && !hit ? 1 : 0;
            row.false_hits += hit && !truly ? 1 : 0;
            if (any || !hit || !truly) continue;
            const std::int64_t off = ulps(hits.t[i], truth.t[i]);
            if (hits.slot[i] != truth.slot[i]) {
                row.wrong_object += off > tie_ulps ? 1 : 0;
                continue;
            }
            distances.push_back(static_cast<double>(off));
            angles.push_back(angle(hits, truth, i));
        }
        row.compared = distances.size();
        set_quantiles(std::move(distances), row.ulp_p50, row.ulp_p99, row.ulp_max);
        set_quantiles(std::move(angles), row.angle_p50, row.angle_p99, row.angle_max);
        rows.push_back(row);
    }
    return rows;
}

} // namespace lanecast::trade
