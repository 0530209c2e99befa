#include "cli/bench/features.hpp"

#include "cli/bench/quantile.hpp"
#include "cli/json_writer.hpp"
#include "cli/machine.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "render/renderer.hpp"
#include "scene/aligned_bytes.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>

#include <time.h>

namespace lanecast::bench {
namespace {

bool has(const RenderJob& job, std::uint32_t features) { return (job.scene.features & features) != 0; }

bool has_extended_light(const SceneView& scene) {
    return std::any_of(scene.lights, scene.lights + scene.light_count, [](const LightRecord& l) { return l.radius > 0; });
}

/// A feature that a job can be told of without changing its pixels.
struct Claim {
    const char* feature;
    bool (*is_absent)(const RenderJob&);
    void (*claim)(RenderJob&);
};
constexpr Claim claims[] = {
    {"planes", [](const RenderJob& j) { return !has(j, feature_planes); },
     [](RenderJob& j) { j.scene.features |= feature_planes; }},
    {"soft shadows",
     [](const RenderJob& j) {
         return j.shadows != 0 && j.soft_samples == 0 && j.scene.light_count > 0 && !has_extended_light(j.scene);
     },
     [](RenderJob& j) { j.soft_samples = 1; }},
    {"transmissive shadows",
     [](const RenderJob& j) { return j.shadows != 0 && j.scene.light_count > 0 && !has(j, feature_transmissive); },
     [](RenderJob& j) { j.transmissive_shadows = 1; }},
    {"reflection", [](const RenderJob& j) { return !has(j, feature_reflective); },
     [](RenderJob& j) { j.scene.features |= feature_reflective; }},
    {"transmission", [](const RenderJob& j) { return !has(j, feature_transmissive); },
     [](RenderJob& j) { j.scene.features |= feature_transmissive; }},
    {"cut-off", [](const RenderJob& j) { return j.cutoff == 0 && has(j, feature_reflective | feature_transmissive); },
     [](RenderJob& j) { j.cutoff = std::numeric_limits<float>::min(); }},
};

double processor_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A job with what it needs to be rendered again and again by one thread.
struct Contender {
    const KernelTable& kernels;
    RenderJob job;
    Film film;
    AlignedBytes scratch;
    std::vector<double> seconds; ///< of each frame

    Contender(const KernelTable& kernels_, const RenderJob& job_) : kernels(kernels_), job(job_) {
        film = make_film(job.image_width, job.image_height, {0, 0, job.image_width, job.image_height});
        job.film = view(film);
        scratch = make_aligned_bytes(kernels.scratch_bytes(job));
    }
    Contender(const Contender&) = delete;
    Contender& operator=(const Contender&) = delete;

    void render() {
        const TileGrid tiles({0, 0, job.image_width, job.image_height}, job.tile_size);
        const double begin = processor_seconds();
        for (std::size_t i = 0; i < tiles.count(); ++i) static_cast<void>(kernels.render_tile(job, tiles.at(i), scratch.get()));
        seconds.push_back(processor_seconds() - begin);
    }
};

std::uint64_t differing_pixels(const Film& a, const Film& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.rgb[0].size(); ++i) {
        bool differs = false;
        for (std::size_t c = 0; c < 3; ++c) differs = differs || std::memcmp(&a.rgb[c][i], &b.rgb[c][i], sizeof(float)) != 0;
        count += differs ? 1 : 0;
    }
    return count;
}

} // namespace

FeaturesReport measure_features(const FeaturesRequest& request) {
    const LoadedScene loaded = load_scene(request.scene);
    const RenderSettings& settings = loaded.description.render;
    const SceneArrays arrays = flatten(loaded.description, settings, 1);
    const KernelTable& kernels =
        find_kernels(request.isa, request.precision.empty() ? settings.precision : precision_named(request.precision));
    FrameOptions options;
    options.width = request.width, options.height = request.height;
    RenderJob own = make_job(arrays, loaded.description.camera, settings, options);
    const PixelOrder order = pixel_order(settings, options);
    own.pixel_order[0] = order.x.data(), own.pixel_order[1] = order.y.data();
    own.pixel_order_count = order.count;

    FeaturesReport report{request.scene,
                          kernels.isa,
                          name_of(kernels.precision),
                          cpu_name(),
                          compiler_name(),
                          "",
                          request.width,
                          request.height,
                          request.pairs,
                          0,
                          {}};
    RenderJob all = own;
    const auto measure = [&](const char* feature, const RenderJob& job) {
        Contender without(kernels, own), with(kernels, job);
        without.render(), with.render(); // touches their memory
        FeatureRow row;
        row.feature = feature;
        row.differing_pixels = differing_pixels(without.film, with.film);
        without.seconds.clear(), with.seconds.clear();
        std::vector<double> gains;
        for (int pair = 0; pair < request.pairs; ++pair) {
            (pair % 2 == 0 ? without : with).render();
            (pair % 2 == 0 ? with : without).render();
            gains.push_back(with.seconds.back() / without.seconds.back());
        }
        const double least = quantile(without.seconds, 0);
        row.gain = quantile(gains, 0.5), row.low = quantile(gains, 0.25), row.high = quantile(gains, 0.75);
        row.least = quantile(with.seconds, 0) / least;
        report.seconds = report.rows.empty() ? least : std::min(report.seconds, least);
        report.rows.push_back(row);
    };
    for (const Claim& claim : claims) {
        if (!claim.is_absent(own)) continue;
        RenderJob job = own;
        claim.claim(job), claim.claim(all);
        measure(claim.feature, job);
    }
    if (report.rows.size() > 1) measure("all of these", all);
    return report;
}

std::string text_report(const FeaturesReport& report) {
    char out[256];
    std::string text = report.scene + ", " + std::to_string(report.width) + "x" + std::to_string(report.height) + ", " +
                       report.isa + ", " + report.precision + ", one thread: " + short_seconds(report.seconds) + "; " +
                       counted(static_cast<std::size_t>(report.pairs), "pair") +
                       " of frames, processor time with the feature over without\n";
    std::snprintf(out, sizeof out, "%-22s %8s %16s %8s\n", "left out", "gain", "quartiles", "least");
    text += out;
    for (const FeatureRow& row : report.rows) {
        std::snprintf(out, sizeof out, "%-22s %8.3f %7.3f to %5.3f %8.3f%s\n", row.feature.c_str(), row.gain, row.low, row.high,
                      row.least, row.differing_pixels > 0 ? "   OTHER PIXELS" : "");
        text += out;
    }
    return text;
}

std::string json_report(const FeaturesReport& report) {
    JsonWriter json;
    json.open_object();
    json.add("scene", report.scene);
    json.add("width", report.width);
    json.add("height", report.height);
    json.add("isa", report.isa);
    json.add("precision", report.precision);
    json.add("cpu", report.cpu);
    json.add("compiler", report.compiler);
    json.add("commit", report.commit);
    json.add("pairs", report.pairs);
    json.add("seconds", report.seconds);
    json.open_list("left_out");
    for (const FeatureRow& row : report.rows) {
        json.open_object();
        json.add("feature", row.feature);
        json.add("gain", row.gain);
        json.add("quartile_low", row.low);
        json.add("quartile_high", row.high);
        json.add("least", row.least);
        json.add("differing_pixels", row.differing_pixels);
        json.close_object();
    }
    json.close_list();
    json.close_object();
    return json.finished();
}

} // namespace lanecast::bench
