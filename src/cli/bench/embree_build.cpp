// Embree's build of a tree, timed.

#include "cli/bench/builds.hpp"

#if LANECAST_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "scene/error.hpp"

#include <cstring>
#include <map>

namespace lanecast::bench {
namespace {

double bytes = 0; ///< of the scene at work

/// Devices are kept: starting threads is no part of a build.
RTCDevice find_device(const std::string& config) {
    static std::map<std::string, RTCDevice> devices;
    RTCDevice& device = devices[config];
    if (device == nullptr) {
        device = rtcNewDevice(config.c_str());
        if (device == nullptr) throw Error(ExitCode::isa, "bench: Embree has no device for " + config);
        rtcSetDeviceMemoryMonitorFunction(
            device,
            [](void*, ssize_t change, bool) {
                bytes += static_cast<double>(change);
                return true;
            },
            nullptr);
    }
    return device;
}

} // namespace

extern "C" __attribute__((visibility("default"))) bool lanecast_time_embree_build(const BenchMesh& mesh, const std::string& isa,
                                                                                  bool high, int threads, BuildTime& time) {
    if (isa == "scalar") return false;
    const RTCDevice device = find_device("isa=" + isa + ",hugepages=1,threads=" + std::to_string(threads));
    bytes = 0;
    const RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size() / 3);
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles());
    std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(float));
    std::memcpy(indices, mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    const Stopwatch watch;
    rtcCommitScene(scene);
    watch.stop(time);
    time.bytes = bytes;
    rtcReleaseScene(scene);
    return true;
}

} // namespace lanecast::bench
