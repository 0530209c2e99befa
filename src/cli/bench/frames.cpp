#include "cli/bench/frames.hpp"

#include "cli/bench/quantile.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "render/renderer.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <chrono>
#include <cstdio>
#include <vector>

namespace lanecast::bench {
namespace {

constexpr const char* kind_names[ray_kind_count] = {"primary", "offset", "shadow", "reflection", "refraction"};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

template <class... Values>
void line(std::string& text, const char* format, Values... values) {
    char out[256];
    std::snprintf(out, sizeof out, format, values...);
    text += out;
    text += '\n';
}

struct Stages {
    std::vector<double> whole, tracing[ray_kind_count], rest; ///< seconds per frame, processor time but for `whole`
    std::uint64_t rays[ray_kind_count] = {};
};

void add_frame(Stages& stages, const FrameStats& stats) {
    std::uint64_t tracing = 0;
    for (int kind = 0; kind < ray_kind_count; ++kind) {
        const RayKindStats& k = stats.tiles.kinds[kind];
        tracing += k.ticks;
        stages.tracing[kind].push_back(static_cast<double>(k.ticks) / stats.ticks_per_second);
        stages.rays[kind] = k.rays;
    }
    stages.rest.push_back(static_cast<double>(stats.tiles.total_ticks - tracing) / stats.ticks_per_second);
    stages.whole.push_back(stats.seconds);
}

void add_shares(std::string& text, const Stages& stages) {
    const double rest = quantile(stages.rest, 0.5);
    double all = rest;
    for (const auto& kind : stages.tracing) all += quantile(kind, 0.5);
    line(text, "  %-20s %9s %8s %12s", "stage, one thread", "median", "share", "rays/s");
    for (int kind = 0; kind < ray_kind_count; ++kind) {
        if (stages.rays[kind] == 0) continue;
        const double seconds = quantile(stages.tracing[kind], 0.5);
        line(text, "  trace %-14s %9s %6.1f %% %12s", kind_names[kind], short_seconds(seconds).c_str(), 100 * seconds / all,
             short_count(static_cast<double>(stages.rays[kind]) / seconds).c_str());
    }
    line(text, "  %-20s %9s %6.1f %%   camera rays, shading, queues, film", "outside traversal", short_seconds(rest).c_str(),
         100 * rest / all);
}

} // namespace

std::string measure_frames(const FramesRequest& request) {
    const auto begin = Clock::now();
    const LoadedScene loaded = load_scene(request.scene);
    const double load_seconds = seconds_since(begin);
    const SceneDescription& scene = loaded.description;
    const auto flatten_begin = Clock::now();
    const SceneArrays arrays = flatten(scene, scene.render, request.threads);
    const double flatten_seconds = seconds_since(flatten_begin);
    const KernelTable& kernels =
        find_kernels(request.isa, request.precision.empty() ? scene.render.precision : precision_named(request.precision));
    FrameOptions options;
    options.width = request.width;
    options.height = request.height;

    Stages stages;
    std::vector<double> speedups, both;
    for (int i = -request.warm_up; i < request.pairs; ++i) {
        options.threads = 1;
        const FrameStats one = render_frame(kernels, arrays, scene.camera, scene.render, options).stats;
        options.threads = request.threads;
        const FrameStats more = render_frame(kernels, arrays, scene.camera, scene.render, options).stats;
        if (i < 0) continue;
        add_frame(stages, one);
        both.push_back(more.seconds);
        speedups.push_back(one.seconds / more.seconds);
    }

    std::string text;
    line(text, "%s, %dx%d, %s, %s, %d pairs of frames", request.scene.c_str(), request.width, request.height, kernels.isa,
         name_of(kernels.precision), request.pairs);
    line(text, "  load %s, flatten %s", short_seconds(load_seconds).c_str(), short_seconds(flatten_seconds).c_str());
    add_shares(text, stages);
    line(text, "  frame: one thread %s, %d threads %s", short_seconds(quantile(stages.whole, 0.5)).c_str(), request.threads,
         short_seconds(quantile(both, 0.5)).c_str());
    line(text, "  speed-up of a pair: median %.3f, quartiles %.3f to %.3f, all %.3f to %.3f", quantile(speedups, 0.5),
         quantile(speedups, 0.25), quantile(speedups, 0.75), quantile(speedups, 0), quantile(speedups, 1));
    return text;
}

} // namespace lanecast::bench
