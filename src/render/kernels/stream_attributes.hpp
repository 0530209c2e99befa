#pragma once
// What a caller of the library may ask of a hit beside its distance: whose it is, and its normal and barycentric weights, which
// are computed once, here.

#include "render/kernels/rays.hpp"
#include "render/kernels/surface.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {
namespace detail {

/// id_of(slot) for hits. Without a branch: slot 0 is looked up for a miss.
template <class Id>
LANECAST_INLINE void write_ids(std::uint32_t* to, const std::int32_t* slot, std::uint32_t n, Id&& id_of) {
#pragma GCC ivdep
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t id = id_of(slot[i] < 0 ? 0 : slot[i]);
        to[i] = slot[i] < 0 ? no_object : id;
    }
}

LANECAST_INLINE void write_names(const SceneView& scene, const RayStream& stream, std::uint32_t begin, std::uint32_t n,
                                 const std::int32_t* slot) {
    const bool empty = scene.first_slot[primitive_kind_count] == 0;
    const std::uint32_t *const object = scene.object, *const scene_id = scene.scene_id;
    const StreamObject* const objects = stream.objects;
    if (stream.object != nullptr) {
        std::uint32_t* const to = stream.object + begin;
        if (empty || objects == nullptr)
            write_ids(to, slot, n, [](std::int32_t) { return 0u; });
        else
            write_ids(to, slot, n, [=](std::int32_t s) { return object[s]; });
    }
    if (stream.primitive != nullptr) {
        std::uint32_t* const to = stream.primitive + begin;
        if (empty)
            write_ids(to, slot, n, [](std::int32_t) { return 0u; });
        else if (objects == nullptr)
            write_ids(to, slot, n, [=](std::int32_t s) { return scene_id[s]; });
        else
            write_ids(to, slot, n, [=](std::int32_t s) { return scene_id[s] - objects[object[s]].first_scene_id; });
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
            u = select(triangles, hit.weight_b, u);
            v = select(triangles, hit.weight_c, v);
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
        if (stream.objects == nullptr) continue;
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
