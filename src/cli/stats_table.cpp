#include "cli/print.hpp"
#include "cli/render_report.hpp"
#include "render/dispatch.hpp"
#include "scene/bvh_quality.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cstdio>

#include <sys/resource.h>

namespace lanecast {
namespace {

constexpr const char* ray_names[ray_kind_count] = {"primary", "offset", "shadow", "reflection", "refraction"};

template <class... Values>
void line(std::string& table, const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    std::string out = text;
    out.erase(out.find_last_not_of(' ') + 1);
    table += out + "\n";
}

double ratio(double a, double b) { return b > 0 ? a / b : 0; }
double as_double(std::uint64_t count) { return static_cast<double>(count); }

void add_stage(std::string& table, const char* name, double seconds, const std::string& note) {
    line(table, "  %-20s %9s  %s", name, short_seconds(seconds).c_str(), note.c_str());
}

/// Of the frame: what its threads did with their time.
void add_frame(std::string& table, const FrameStats& stats) {
    const double in_tiles = as_double(stats.tiles.total_ticks);
    std::uint64_t tracing = 0;
    const auto add = [&](const char* name, double ticks) {
        line(table, "    %-18s %9s  %5.1f %%", name, short_seconds(ratio(ticks, stats.ticks_per_second)).c_str(),
             100 * ratio(ticks, stats.threads * stats.seconds * stats.ticks_per_second));
    };
    for (int kind = 0; kind < ray_kind_count; ++kind) {
        const RayKindStats& k = stats.tiles.kinds[kind];
        tracing += k.ticks;
        if (k.rays > 0) add((std::string("trace ") + ray_names[kind]).c_str(), as_double(k.ticks));
    }
    add("shade, rest", in_tiles - as_double(tracing));
    add("idle", std::max(0.0, stats.threads * stats.seconds * stats.ticks_per_second - in_tiles));
}

void add_rays(std::string& table, const FrameStats& stats) {
    line(table, "%-14s %12s %10s %10s %9s %8s %8s", "rays", "count", "batches", "per batch", "rays/s", "first", "last");
    RayKindStats sum{};
    const auto add = [&](const char* name, const RayKindStats& k) {
        line(table, "  %-12s %12llu %10llu %10.1f %9s %6.1f %% %6.1f %%", name, static_cast<unsigned long long>(k.rays),
             static_cast<unsigned long long>(k.batches), ratio(as_double(k.rays), as_double(k.batches)),
             short_count(ratio(as_double(k.rays), ratio(as_double(k.ticks), stats.ticks_per_second))).c_str(),
             100 * ratio(as_double(k.first_active), as_double(k.first_lanes)),
             100 * ratio(as_double(k.last_active), as_double(k.last_lanes)));
    };
    for (int kind = 0; kind < ray_kind_count; ++kind) {
        const RayKindStats& k = stats.tiles.kinds[kind];
        if (k.rays > 0) add(ray_names[kind], k);
        sum.rays += k.rays;
        sum.batches += k.batches;
    }
    line(table, "  %-12s %12llu %10llu %10.1f %9s", "all", static_cast<unsigned long long>(sum.rays),
         static_cast<unsigned long long>(sum.batches), ratio(as_double(sum.rays), as_double(sum.batches)),
         short_count(ratio(as_double(sum.rays), stats.seconds)).c_str());
}

double peak_bytes() {
    rusage usage{};
    return ::getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * static_cast<double>(usage.ru_maxrss) : 0;
}

} // namespace

std::string stats_table(const RenderReport& report, const SceneArrays& arrays) {
    const FrameStats& stats = report.stats;
    std::string table;
    line(table, "%-14s %s", "scene", printable_path(report.scene).c_str());
    line(table, "%-14s %d x %d, tiles of %d", "image", report.options.width, report.options.height, report.options.tile_size);
    line(table, "%-14s %s, %s, %s per vector", "kernels", report.isa.c_str(),
         (name_of(report.settings.precision) + std::string(report.settings.precision >= Precision::precise ? " (double)" : ""))
             .c_str(),
         counted(static_cast<std::size_t>(report.width), "ray").c_str());
    line(table, "%-14s %d", "threads", stats.threads);
    line(table, "time");
    add_stage(table, "load", report.load_seconds, "");
    add_stage(table, "bake", report.flatten_seconds, "");
    add_stage(table, "build", report.build_seconds, "");
    add_stage(table, "frame", stats.seconds,
              "of which, summed over " + counted(static_cast<std::size_t>(stats.threads), "thread") + ":");
    add_frame(table, stats);
    add_stage(table, "write", report.write_seconds, "");
    add_rays(table, stats);
    const BvhQuality tree = measure_quality(arrays.arena.get());
    line(table, "%-14s %s, %u %s, %s, SAH cost %.4g", "tree", counted(tree.nodes, "node").c_str(), tree.leaves,
         tree.leaves == 1 ? "leaf" : "leaves", counted(static_cast<std::size_t>(tree.depth), "level").c_str(), tree.sah_cost);
    line(table, "%-14s scene %s, peak %s", "memory", short_bytes(static_cast<double>(memory_bytes(arrays))).c_str(),
         short_bytes(peak_bytes()).c_str());
    return table;
}

} // namespace lanecast
