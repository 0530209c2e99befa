#include "cli/bench/builds.hpp"

#include "cli/bench/quantile.hpp"
#include "cli/print.hpp"
#include "lanecast/describe.hpp"
#include "scene/bvh_quality.hpp"
#include "scene/flatten.hpp"

#include <cstdio>
#include <thread>
#include <vector>

namespace lanecast::bench {
namespace {

/// "0.93 (0.91 to 0.96)": the median and the quartiles.
std::string with_spread(const std::vector<double>& values) {
    return fixed(quantile(values, 0.5), 3) + " (" + fixed(quantile(values, 0.25), 3) + " to " + fixed(quantile(values, 0.75), 3) +
           ")";
}

/// Threads that wait for more work a while stand in nobody's way.
void let_threads_sleep() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

struct Times {
    std::vector<double> wall, processor;
    void add(const BuildTime& time) {
        wall.push_back(time.wall);
        processor.push_back(time.processor);
    }
};

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> quotient;
    for (std::size_t i = 0; i < a.size(); ++i) quotient.push_back(a[i] / b[i]);
    return quotient;
}

} // namespace

std::string measure_builds(const BenchMesh& mesh, const std::string& isa, const BuildsRequest& request, bool header) {
    const MeshArrays arrays = mesh.arrays();
    const SceneDescription scene = describe(std::span(&arrays, 1));
    RenderSettings settings;
    settings.bvh = request.high ? BvhMode::quality : BvhMode::standard;
    BuildTime own, peer;
    Times ours, theirs;
    BvhQuality quality;
    for (int r = -1; r < request.repetitions; ++r) { // the first is not counted
        let_threads_sleep();
        {
            const Stopwatch watch;
            const SceneArrays built = flatten(scene, settings, request.threads);
            watch.stop(own);
            own.bytes = static_cast<double>(memory_bytes(built));
            quality = measure_quality(built.arena.get());
        }
        let_threads_sleep();
        const bool there = request.with_peer && time_embree_build(mesh, isa, request.high, request.threads, peer);
        if (r < 0) continue;
        ours.add(own);
        if (there) theirs.add(peer);
    }

    const auto triangles = static_cast<double>(mesh.triangles());
    char out[512];
    std::string text;
    if (header) {
        std::snprintf(out, sizeof out, "%-16s %9s %8s %7s %7s %5s %7s %7s  %-26s %s\n", "mesh", "triangles", "ns/tri", "Mtri/s",
                      "B/tri", "SAH", "peer ns", "B/tri", "wall, ours/peer", "processor time, ours/peer");
        text += out;
    }
    std::snprintf(out, sizeof out, "%-16s %9zu %8.1f %7.2f %7.1f %5.1f", mesh.name.c_str(), mesh.triangles(),
                  1e9 * quantile(ours.wall, 0.5) / triangles, 1e-6 * triangles / quantile(ours.wall, 0.5), own.bytes / triangles,
                  quality.sah_cost);
    text += out;
    if (!theirs.wall.empty()) {
        std::snprintf(out, sizeof out, " %7.1f %7.1f  %-26s %s", 1e9 * quantile(theirs.wall, 0.5) / triangles,
                      peer.bytes / triangles, with_spread(ratios(ours.wall, theirs.wall)).c_str(),
                      with_spread(ratios(ours.processor, theirs.processor)).c_str());
        text += out;
    }
    return text + "\n";
}

} // namespace lanecast::bench
