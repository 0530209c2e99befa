#pragma once
// From a slot to its record: slots number triangles, spheres, ellipsoids, cylinders, cones, open cones and planes, in this order.

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
/// Index into affines and affine_shading, of an ellipsoid, a cylinder or a cone.
LANECAST_INLINE std::uint32_t affine_index(const SceneView& scene, std::uint32_t slot) {
    return slot - first_slot(scene, PrimitiveKind::ellipsoid);
}
LANECAST_INLINE const PlaneRecord& plane_at(const SceneView& scene, std::uint32_t slot) {
    return scene.planes[slot - first_slot(scene, PrimitiveKind::plane)];
}

/// The slots of a leaf's triangles. A triangle has one, in however many leaves it stands.
struct TriangleSlots {
    std::uint32_t first;
    const std::uint32_t* shared; ///< null: they count up from `first`

    [[nodiscard]] LANECAST_INLINE std::uint32_t operator[](std::uint32_t i) const { return shared ? shared[i] : first + i; }
};
LANECAST_INLINE bool is_of_triangles(std::uint64_t leaf) {
    const auto kind = static_cast<std::uint32_t>((leaf >> child_kind_shift) & child_kind_mask);
    return kind == static_cast<std::uint32_t>(PrimitiveKind::triangle) || kind == leaf_of_shared;
}
LANECAST_INLINE TriangleSlots triangle_slots(const SceneView& scene, std::uint64_t leaf) {
    const auto first = static_cast<std::uint32_t>(leaf);
    const bool shared = ((leaf >> child_kind_shift) & child_kind_mask) == leaf_of_shared;
    return {first, shared ? scene.shared_slots + first : nullptr};
}

/// Lanes whose slot lies in [first, end).
template <FloatBatch F>
LANECAST_INLINE Mask<F> slot_between(Int<F> slot, std::uint32_t first, std::uint32_t end) {
    return (slot > Int<F>(static_cast<std::int32_t>(first) - 1)) & (Int<F>(static_cast<std::int32_t>(end)) > slot);
}
/// Spheres, ellipsoids, cylinders and cones, open or not: surfaces of convex bodies, with an inside.
template <FloatBatch F>
LANECAST_INLINE Mask<F> is_quadric(const SceneView& scene, Int<F> slot) {
    return slot_between<F>(slot, first_slot(scene, PrimitiveKind::sphere), end_slot(scene, PrimitiveKind::open_cone));
}

} // namespace lanecast::inline LANECAST_ISA
