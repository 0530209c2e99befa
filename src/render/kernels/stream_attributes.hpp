#pragma once
// What a caller of the library may ask of a hit beside its distance: whose it is, and its normal and barycentric weights, which
// are computed once, here.

#include "render/kernels/rays.hpp"
#include "render/kernels/surface.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {
namespace detail {

/// Stores the first n lanes.
template <FloatBatch F>
LANECAST_INLINE void store_ids(std::uint32_t* to, Int<F> ids, std::uint32_t n) {
    alignas(64) std::int32_t lanes[width<F>];
    const bool whole = n >= static_cast<std::uint32_t>(width<F>);
    store(whole ? reinterpret_cast<std::int32_t*>(to) : lanes, ids);
    if (!whole) __builtin_memcpy(to, lanes, n * sizeof lanes[0]);
}

template <FloatBatch F>
LANECAST_INLINE void write_names(const SceneView& scene, const RayStream& stream, std::uint32_t begin, std::uint32_t n,
                                 const std::int32_t* slots) {
    constexpr std::uint32_t W = width<F>;
    const Int<F> none_found(static_cast<std::int32_t>(no_object));
    for (std::uint32_t i = 0; i < n; i += W) {
        const Int<F> slot = load_int<F>(slots + i);
        const Mask<F> found = first_lanes<F>(n - i) & (slot > Int<F>(-1));
        Int<F> object = none_found, primitive = none_found;
        if (any(found)) {
            // Lanes of coherent rays have often hit one primitive. AVX-512 1.02, AVX2 1.0; of four lanes to ask costs more.
            const bool same = W >= 8 && all(found & (slot == Int<F>(slots[i])));
            const auto look_up = [&](const std::uint32_t* table, Int<F> at) {
                if (same) return Int<F>(static_cast<std::int32_t>(table[slots[i]]));
                return gather(reinterpret_cast<const std::int32_t*>(table), at);
            };
            const Int<F> at = select(found, slot, Int<F>(0));
            Int<F> number = look_up(scene.scene_id, at), owner(0);
            if (stream.objects != nullptr) {
                owner = look_up(scene.object, at);
                number = number - gather(reinterpret_cast<const std::int32_t*>(&stream.objects->first_scene_id), owner + owner);
            }
            object = select(found, owner, none_found);
            primitive = select(found, number, none_found);
        }
        if (stream.object != nullptr) store_ids<F>(stream.object + begin + i, object, n - i);
        if (stream.primitive != nullptr) store_ids<F>(stream.primitive + begin + i, primitive, n - i);
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
