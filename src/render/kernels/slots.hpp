#pragma once
// From a slot to its record: slots number triangles, spheres, ellipsoids, cylinders and planes, in this order.

#include "scene/scene_view.hpp"
#include "simd/batch.hpp"

namespace lanecast::inline LANECAST_ISA {

LANECAST_INLINE std::uint32_t first_slot(const SceneView& scene, PrimitiveKind kind) {
    return scene.first_slot[static_cast<std::uint32_t>(kind)];
}
LANECAST_INLINE std::uint32_t end_slot(const SceneView& scene, PrimitiveKind kind) {
    return scene.first_slot[static_cast<std::uint32_t>(kind) + 1];
}

LANECAST_INLINE const SphereRecord& sphere_at(const SceneView& scene, std::uint32_t slot) {
    return scene.spheres[slot - first_slot(scene, PrimitiveKind::sphere)];
}
/// Index into affines and affine_shading, of an ellipsoid or a cylinder.
LANECAST_INLINE std::uint32_t affine_index(const SceneView& scene, std::uint32_t slot) {
    return slot - first_slot(scene, PrimitiveKind::ellipsoid);
}
LANECAST_INLINE const PlaneRecord& plane_at(const SceneView& scene, std::uint32_t slot) {
    return scene.planes[slot - first_slot(scene, PrimitiveKind::plane)];
}

/// Of the triangle that a leaf's word numbers: one slot, in however many leaves it stands.
LANECAST_INLINE std::uint32_t triangle_slot(const SceneView& scene, std::uint32_t reference) {
    return scene.triangle_slot != nullptr ? scene.triangle_slot[reference] : reference;
}

/// Lanes whose slot lies in [first, end).
template <FloatBatch F>
LANECAST_INLINE Mask<F> slot_between(Int<F> slot, std::uint32_t first, std::uint32_t end) {
    return (slot > Int<F>(static_cast<std::int32_t>(first) - 1)) & (Int<F>(static_cast<std::int32_t>(end)) > slot);
}
/// Spheres, ellipsoids and cylinders: convex, with an inside.
template <FloatBatch F>
LANECAST_INLINE Mask<F> is_quadric(const SceneView& scene, Int<F> slot) {
    return slot_between<F>(slot, first_slot(scene, PrimitiveKind::sphere), end_slot(scene, PrimitiveKind::cylinder));
}

} // namespace lanecast::inline LANECAST_ISA
