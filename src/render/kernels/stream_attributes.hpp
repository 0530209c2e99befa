#pragma once
// What a caller of the library may ask of a hit beside its distance: whose it is, and its normal and barycentric weights, which
// are computed once, here.

#include "render/kernels/rays.hpp"
#include "render/kernels/surface.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {
namespace detail {

inline void write_names(const SceneView& scene, const RayStream& stream, std::uint32_t begin, std::uint32_t n,
                        const std::int32_t* slot) {
    std::uint32_t* const object = stream.object != nullptr ? stream.object + begin : nullptr;
    std::uint32_t* const primitive = stream.primitive != nullptr ? stream.primitive + begin : nullptr;
    for (std::uint32_t i = 0; i < n; ++i) {
        if (slot[i] < 0) {
            if (object != nullptr) object[i] = no_object;
            if (primitive != nullptr) primitive[i] = no_object;
            continue;
        }
        const std::uint32_t owner = scene.object[slot[i]];
        if (object != nullptr) object[i] = owner;
        if (primitive != nullptr) primitive[i] = scene.scene_id[slot[i]] - stream.objects[owner].first_scene_id;
    }
}

/// Stores the first n lanes.
template <FloatBatch F>
LANECAST_INLINE void store_lanes(float* to, F lanes, std::uint32_t n) {
    alignas(64) Scalar<F> values[width<F>];
    store(values, lanes);
    for (std::uint32_t i = 0; i < n && i < static_cast<std::uint32_t>(width<F>); ++i) to[i] = static_cast<float>(values[i]);
}

template <FloatBatch F>
void write_attributes(const SceneView& scene, const RayStream& stream, std::uint32_t begin, std::uint32_t n,
                      const RayBatch<F>& rays) {
    constexpr std::uint32_t W = width<F>;
    for (std::uint32_t i = 0; i < n; i += W) {
        const Int<F> slot = load_int<F>(rays.slot + i);
        const Mask<F> found = first_lanes<F>(n - i) & (slot > Int<F>(-1));
        const Mask<F> triangles =
            found & slot_between<F>(slot, first_slot(scene, PrimitiveKind::triangle), end_slot(scene, PrimitiveKind::triangle));
        const Mask<F> others = found & !triangles;
        const Vec3<F> org = load<F>(rays.org, i), dir = load<F>(rays.dir, i);
        Vec3<F> normal{F(0), F(0), F(0)};
        F u(0), v(0);
        if (any(triangles)) {
            const TriangleHit<F> hit = triangle_hit(scene, org, dir, slot, triangles);
            normal = select(triangles, hit.normal, normal);
            u = select(triangles, hit.edges.v * hit.inv_det, u);
            v = select(triangles, hit.edges.w * hit.inv_det, v);
        }
        if (any(others)) {
            const Surface<F> surface = surface_at(scene, org, dir, load<F>(rays.t + i), slot, others);
            normal = select(others, select(surface.inside, -surface.normal, surface.normal), normal);
        }
        if (stream.normal[0] != nullptr) {
            store_lanes(stream.normal[0] + begin + i, normal.x, n - i);
            store_lanes(stream.normal[1] + begin + i, normal.y, n - i);
            store_lanes(stream.normal[2] + begin + i, normal.z, n - i);
        }
        if (stream.u == nullptr) continue;
        store_lanes(stream.u + begin + i, u, n - i);
        store_lanes(stream.v + begin + i, v, n - i);
        for_each_bit(bits(triangles), [&](std::uint32_t lane) {
            if (stream.objects[scene.object[rays.slot[i + lane]]].mirrored == 0) return;
            const std::uint32_t k = begin + i + lane;
            const float second = stream.u[k];
            stream.u[k] = stream.v[k];
            stream.v[k] = second;
        });
    }
}

} // namespace detail
} // namespace lanecast::inline LANECAST_ISA
