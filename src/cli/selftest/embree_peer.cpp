// Embree as it is meant to be used: spheres are its points, cylinders and cones that are round its curves, ellipsoids instances
// of a point; denormals are zero while it traces; single rays where rays have nothing in common, packets of the instruction
// set's width where they have. Its curves take directions for unit vectors, though its manual asks for none (3.13.5): where there
// are curves it gets unit directions. So cylinders and cones that are not round, which instances would have to be, are left out.

#include "cli/embree_query.hpp"
#include "cli/selftest/peer.hpp"
#include "scene/error.hpp"

#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>

namespace lanecast::selftest {
namespace {

constexpr unsigned triangles_id = 0, spheres_id = 1, curves_id = 2, first_instance_id = 3;

/// Kept: making one takes longer than a small scene.
RTCDevice device_for(const std::string& isa) {
    static std::mutex mutex;
    static std::map<std::string, RTCDevice> devices;
    const std::lock_guard lock(mutex);
    RTCDevice& device = devices[isa];
    if (device == nullptr) device = rtcNewDevice(("isa=" + isa).c_str());
    return device;
}

struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Scene = std::unique_ptr<RTCSceneTy, SceneRelease>;

Scene new_scene(RTCDevice device, bool robust) {
    Scene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    return scene;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t bytes, std::size_t count, const void* from) {
    std::memcpy(rtcSetNewGeometryBuffer(geometry, type, 0, format, bytes, count), from, bytes * count);
}

void add_triangles(RTCDevice device, RTCScene scene, const std::vector<float>& corners) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::vector<std::uint32_t> indices(corners.size() / 3);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 12, indices.size(), corners.data());
    fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 12, indices.size() / 3, indices.data());
    attach(scene, geometry, triangles_id);
}

void add_spheres(RTCDevice device, RTCScene scene, const SphereRecord* spheres, std::size_t count) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 16, count, spheres); // x y z r
    attach(scene, geometry, spheres_id);
}

/// Pairs of ends, x y z r each; segments share none, so each has its caps.
void add_curves(RTCDevice device, RTCScene scene, const std::vector<float>& ends) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    std::vector<std::uint32_t> first(ends.size() / 8);
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = static_cast<std::uint32_t>(2 * i);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 16, 2 * first.size(), ends.data());
    fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 4, first.size(), first.data());
    attach(scene, geometry, curves_id);
}

/// The ends of a body's axis with the radii there, if it is round and upright in its own frame; else nothing.
bool ends_of(const PeerScene::Body& body, std::vector<float>& ends) {
    double column[3][3], length[3];
    for (int c = 0; c < 3; ++c) {
        for (int row = 0; row < 3; ++row) column[c][row] = double{body.world_from_object[3 * row + c]};
        length[c] = std::hypot(column[c][0], column[c][1], column[c][2]);
    }
    constexpr double rounding = 1e-6; // of a matrix of floats
    for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3;
        const double along = column[c][0] * column[d][0] + column[c][1] * column[d][1] + column[c][2] * column[d][2];
        if (std::fabs(along) > rounding * length[c] * length[d]) return false;
    }
    if (std::fabs(length[0] - length[2]) > rounding * length[0]) return false;
    const double radius = 0.5 * (length[0] + length[2]);
    for (const double y : {-0.5, 0.5}) {
        for (int axis = 0; axis < 3; ++axis)
            ends.push_back(static_cast<float>(double{body.translation[axis]} + y * column[1][axis]));
        ends.push_back(static_cast<float>(radius * (1 + y * double{body.taper})));
    }
    return true;
}

void add_ellipsoid(RTCDevice device, RTCScene scene, const PeerScene::Body& body, RTCScene unit_sphere, unsigned id) {
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, unit_sphere);
    float columns[12];
    for (int c = 0; c < 3; ++c)
        for (int row = 0; row < 3; ++row) columns[3 * c + row] = body.world_from_object[3 * row + c];
    std::memcpy(columns + 9, body.translation, sizeof body.translation);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    attach(scene, instance, id);
}

/// A committed scene, and which slot a hit is.
struct Built {
    Scene scene;
    const PeerScene* from;
    std::vector<std::size_t> curve, instance; ///< which body

    /// By which the ray's direction is divided for Embree.
    [[nodiscard]] double length_of(const RayStream& rays, std::size_t i) const {
        if (curve.empty()) return 1;
        const double length = std::hypot(double{rays.dir[0][i]}, double{rays.dir[1][i]}, double{rays.dir[2][i]});
        return length > 0 ? length : 1;
    }
    [[nodiscard]] const PeerScene::Body* body(unsigned geometry, unsigned primitive, unsigned instance_id) const {
        if (instance_id != RTC_INVALID_GEOMETRY_ID) return &from->bodies[instance[instance_id - first_instance_id]];
        return geometry == curves_id ? &from->bodies[curve[primitive]] : nullptr;
    }
};

Built build(RTCDevice device, const PeerScene& from, bool robust) {
    Built built{new_scene(device, robust), &from, {}, {}};
    const RTCScene scene = built.scene.get();
    if (!from.corners.empty()) add_triangles(device, scene, from.corners);
    if (!from.spheres.empty()) add_spheres(device, scene, from.spheres.data(), from.spheres.size());
    const Scene sphere = new_scene(device, robust);
    const SphereRecord unit{{0, 0, 0}, 1};
    add_spheres(device, sphere.get(), &unit, 1);
    rtcCommitScene(sphere.get());
    std::vector<float> ends;
    for (std::size_t i = 0; i < from.bodies.size(); ++i) {
        if (from.bodies[i].kind == PrimitiveKind::ellipsoid) {
            const auto id = first_instance_id + static_cast<unsigned>(built.instance.size());
            add_ellipsoid(device, scene, from.bodies[i], sphere.get(), id);
            built.instance.push_back(i);
        } else if (ends_of(from.bodies[i], ends)) {
            built.curve.push_back(i);
        }
    }
    if (!ends.empty()) add_curves(device, scene, ends);
    rtcCommitScene(scene);
    return built;
}

/// As Embree asks its callers to have it.
class FlushDenormals {
public:
    FlushDenormals() : saved_(__builtin_ia32_stmxcsr()) { __builtin_ia32_ldmxcsr(saved_ | 0x8040u); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
    ~FlushDenormals() { __builtin_ia32_ldmxcsr(saved_); }

private:
    unsigned saved_;
};

template <class Ray>
void set_ray(Ray& ray, std::size_t lane, const RayStream& rays, std::size_t i, double length) {
    const std::size_t o = rays.common_origin != 0 ? 0 : i;
    lane_of(ray.org_x, lane) = rays.org[0][o];
    lane_of(ray.org_y, lane) = rays.org[1][o];
    lane_of(ray.org_z, lane) = rays.org[2][o];
    lane_of(ray.dir_x, lane) = static_cast<float>(double{rays.dir[0][i]} / length);
    lane_of(ray.dir_y, lane) = static_cast<float>(double{rays.dir[1][i]} / length);
    lane_of(ray.dir_z, lane) = static_cast<float>(double{rays.dir[2][i]} / length);
    const double tmin = rays.tmin == nullptr ? 0 : std::fmax(double{rays.tmin[i]}, 0.0);
    const double tmax = rays.tmax == nullptr ? std::numeric_limits<double>::infinity() : double{rays.tmax[i]};
    lane_of(ray.tnear, lane) = static_cast<float>(tmin * length);
    lane_of(ray.tfar, lane) = static_cast<float>(tmax * length);
    lane_of(ray.time, lane) = 0;
    lane_of(ray.mask, lane) = ~0u;
    lane_of(ray.flags, lane) = 0;
}

/// `instance`: whose space the normal is in, null for the world's.
template <class Hit>
void write_normal(const PeerScene::Body* instance, Hit& hit, std::size_t lane, const RayStream& rays, std::size_t i) {
    double n[3] = {lane_of(hit.Ng_x, lane), lane_of(hit.Ng_y, lane), lane_of(hit.Ng_z, lane)};
    if (instance != nullptr) { // times the cofactors of the matrix
        const float* const m = instance->world_from_object;
        double turned[3];
        for (int row = 0; row < 3; ++row) {
            const int r1 = 3 * ((row + 1) % 3), r2 = 3 * ((row + 2) % 3);
            turned[row] = 0;
            for (int c = 0; c < 3; ++c) {
                const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
                turned[row] += n[c] * (double{m[r1 + c1]} * double{m[r2 + c2]} - double{m[r1 + c2]} * double{m[r2 + c1]});
            }
        }
        std::memcpy(n, turned, sizeof n);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    for (int axis = 0; axis < 3; ++axis) rays.normal[axis][i] = static_cast<float>(n[axis] / length);
}

template <class RayHits>
void write_hit(const Built& built, RayHits& packet, std::size_t lane, const RayStream& rays, std::size_t i) {
    const unsigned geometry = lane_of(packet.hit.geomID, lane), primitive = lane_of(packet.hit.primID, lane);
    const bool found = geometry != RTC_INVALID_GEOMETRY_ID;
    std::int32_t slot = -1;
    if (found) {
        const unsigned instance = lane_of(packet.hit.instID[0], lane);
        const PeerScene::Body* const body = built.body(geometry, primitive, instance);
        const auto index = static_cast<std::int32_t>(primitive);
        slot = body != nullptr ? body->slot : geometry == spheres_id ? built.from->first_sphere + index : index;
        if (rays.normal[0] != nullptr)
            write_normal(instance == RTC_INVALID_GEOMETRY_ID ? nullptr : body, packet.hit, lane, rays, i);
    } else if (rays.normal[0] != nullptr) {
        for (float* const axis : rays.normal) axis[i] = 0;
    }
    if (rays.t != nullptr) rays.t[i] = static_cast<float>(double{lane_of(packet.ray.tfar, lane)} / built.length_of(rays, i));
    if (rays.slot != nullptr) rays.slot[i] = slot;
}

template <int width>
void trace(const Built& built, const RayStream& rays, Query query, bool coherent) {
    const FlushDenormals flush;
    Asking asking(coherent);
    for (std::size_t begin = 0; begin < rays.count; begin += width) {
        alignas(64) int valid[width];
        typename Packet<width>::RayHits packet{};
        for (std::size_t lane = 0; lane < width; ++lane) {
            valid[lane] = begin + lane < rays.count ? -1 : 0;
            const std::size_t i = std::min<std::size_t>(begin + lane, rays.count - 1);
            set_ray(packet.ray, lane, rays, i, built.length_of(rays, i));
            lane_of(packet.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
            lane_of(packet.hit.instID[0], lane) = RTC_INVALID_GEOMETRY_ID;
        }
        if (query == Query::any) {
            trace_packet<width>(built.scene.get(), asking, packet.ray, valid); // tfar below 0: something is hit
            for (std::size_t lane = 0; lane < width && begin + lane < rays.count; ++lane)
                rays.slot[begin + lane] = lane_of(packet.ray.tfar, lane) < 0 ? 0 : -1;
            continue;
        }
        trace_packet<width>(built.scene.get(), asking, packet, valid);
        for (std::size_t lane = 0; lane < width && begin + lane < rays.count; ++lane)
            write_hit(built, packet, lane, rays, begin + lane);
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) const char* lanecast_open_embree(const char* isa) {
    if (isa == std::string("scalar") || device_for(isa) == nullptr)
        throw Error(ExitCode::isa, std::string("--peer: Embree has no kernels for ") + isa + " here");
    return RTC_VERSION_STRING;
}

extern "C" __attribute__((visibility("default"))) void lanecast_ask_embree(const PeerScene& scene, const RayStream& rays,
                                                                           const PeerMode& mode) {
    const std::string isa = mode.isa;
    const Built built = build(device_for(isa), scene, mode.robust);
    if (rays.coherent == 0 || rays.count == 1)
        trace<1>(built, rays, mode.query, false);
    else if (isa == "avx512")
        trace<16>(built, rays, mode.query, true);
    else if (isa == "avx2")
        trace<8>(built, rays, mode.query, true);
    else
        trace<4>(built, rays, mode.query, true);
}

} // namespace lanecast::selftest
