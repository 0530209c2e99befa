// Embree's build of a tree, timed.

#include "cli/bench/builds.hpp"
#include "cli/bench/embree_scene.hpp"

#include <map>
#include <utility>

namespace lanecast::bench {
namespace {

double bytes = 0; ///< of the scene at work

/// Devices are kept: starting threads is no part of a build.
RTCDevice find_device(const std::string& isa, int threads) {
    static std::map<std::pair<std::string, int>, RTCDevice> devices;
    RTCDevice& device = devices[{isa, threads}];
    if (device == nullptr) device = make_device(isa, threads, bytes);
    return device;
}

} // namespace

extern "C" __attribute__((visibility("default"))) bool lanecast_time_embree_build(const BenchMesh& mesh, const std::string& isa,
                                                                                  bool high, int threads, BuildTime& time) {
    if (isa == "scalar") return false;
    const RTCDevice device = find_device(isa, threads);
    bytes = 0;
    const RTCScene scene = make_scene(device, mesh, high);
    const Stopwatch watch;
    rtcCommitScene(scene);
    watch.stop(time);
    time.bytes = bytes;
    rtcReleaseScene(scene);
    return true;
}

} // namespace lanecast::bench
