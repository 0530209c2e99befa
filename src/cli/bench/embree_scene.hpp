#pragma once
// What both uses of Embree start from: a device of a given instruction set, and a mesh as a scene that is yet to be committed.

#include "cli/bench/bench_mesh.hpp"
#include "cli/embree_query.hpp"
#include "scene/error.hpp"

#include <cstring>
#include <string>

namespace lanecast::bench {

/// `bytes` follows what the device holds; it outlives the device.
inline RTCDevice make_device(const std::string& isa, int threads, double& bytes) {
    const std::string config = "isa=" + isa + ",hugepages=1,threads=" + std::to_string(threads);
    const RTCDevice device = rtcNewDevice(config.c_str());
    if (device == nullptr) throw Error(ExitCode::isa, "bench: Embree has no device for " + config);
    rtcSetDeviceMemoryMonitorFunction(
        device,
        [](void* held, ssize_t change, bool) {
            *static_cast<double*>(held) += static_cast<double>(change);
            return true;
        },
        &bytes);
    return device;
}

inline RTCScene make_scene(RTCDevice device, const BenchMesh& mesh, bool high) {
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
    return scene;
}

} // namespace lanecast::bench
