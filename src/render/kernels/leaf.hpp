#pragma once
// The primitives of a leaf against a packet, and the rule by which a hit is taken: nearest t, ties to the smaller scene id, so
// that neither the tree nor the grouping of rays can show in the picture.

#include "render/kernels/packet.hpp"
#include "render/kernels/plane.hpp"
#include "render/kernels/quadric.hpp"
#include "render/kernels/slots.hpp"

namespace lanecast::inline LANECAST_ISA {

/// What is asked of the scene. `next`: the nearest hit after (tmin, after) in the order of (t, scene id).
enum class Query { closest, any, next };

/// Ties: the lanes in which the new primitive comes first.
template <FloatBatch F>
Mask<F> first_of_ties(const SceneView& scene, const std::int32_t* best_slots, std::uint32_t tied, std::uint32_t slot) {
    std::uint32_t wins = 0;
    for_each_bit(tied, [&](std::uint32_t lane) {
        const std::int32_t best = best_slots[lane];
        if (best < 0 || scene.scene_id[slot] < scene.scene_id[best]) wins |= 1u << lane;
    });
    return mask_from_bits<F>(wins);
}

/// The lanes of vector i whose search has not yet passed t.
template <Query query, FloatBatch F>
LANECAST_INLINE Mask<F> later(const Packet<F>& packet, std::uint32_t i, F t, std::uint32_t scene_id) {
    const F tmin = load<F>(packet.tmin + i);
    if constexpr (query == Query::next)
        return (t > tmin) | ((t == tmin) & (Int<F>(static_cast<std::int32_t>(scene_id)) > load_int<F>(packet.after + i)));
    else
        return t > tmin;
}

/// Takes the hits of `found` (t in the ray's range, t <= packet.t) into the packet.
template <Query query, FloatBatch F>
LANECAST_INLINE void take(const SceneView& scene, Packet<F>& packet, std::uint32_t i, F t, std::uint32_t slot, Mask<F> found) {
    using S = Scalar<F>;
    const F best = load<F>(packet.t + i);
    if constexpr (query == Query::any) {
        store(packet.t + i, select(found, F(S(-1)), best));
    } else {
        const Mask<F> tied = found & (t == best);
        if (any(tied)) found = (found & !tied) | first_of_ties<F>(scene, packet.slot + i, bits(tied), slot);
        store(packet.t + i, select(found, t, best));
    }
    store(packet.slot + i, select(found, Int<F>(static_cast<std::int32_t>(slot)), load_int<F>(packet.slot + i)));
}

/// A convex body's nearer end that the ray may hit: see `no_source`.
template <Query query, FloatBatch F>
LANECAST_INLINE bool hit_convex(const SceneView& scene, Packet<F>& packet, std::uint32_t i, const Crossing<F>& ends,
                                std::uint32_t slot) {
    if (none(ends.hit)) return false;
    const std::uint32_t id = scene.scene_id[slot];
    const Int<F> source = load_int<F>(packet.source + i);
    const Int<F> this_slot(static_cast<std::int32_t>(slot));
    const Mask<F> outward = source == source_outward(this_slot);
    const Mask<F> inward = source == source_inward(this_slot);
    const Mask<F> enters = later<query>(packet, i, ends.t0, id) & !inward;
    const F t = select(enters, ends.t0, ends.t1);
    const Mask<F> found = ends.hit & !outward & (enters | later<query>(packet, i, ends.t1, id)) & (t <= load<F>(packet.t + i));
    if (none(found)) return false;
    take<query>(scene, packet, i, t, slot, found);
    return true;
}

template <Query query, FloatBatch F>
LANECAST_INLINE bool hit_triangles(const SceneView& scene, Packet<F>& packet, std::uint32_t vectors, const float* block,
                                   const TriangleSlots& slots, std::uint32_t count) {
    using S = Scalar<F>;
    const Axes axes = packet.axes;
    bool hit_any = false;
    for (std::uint32_t lane = 0; lane < count; ++lane) {
        const auto vertex = [&](std::uint32_t v) {
            const float* const row = block + lane + 3 * v * count;
            return Vec3<F>{F(S(row[static_cast<std::uint32_t>(axes.kx) * count])),
                           F(S(row[static_cast<std::uint32_t>(axes.ky) * count])),
                           F(S(row[static_cast<std::uint32_t>(axes.kz) * count]))};
        };
        const Vec3<F> a = vertex(0), b = vertex(1), c = vertex(2);
        for_each_bit(vectors, [&](std::uint32_t vector) {
            const std::uint32_t i = vector * width<F>;
            const ShearedRay<F> ray = packet.sheared(i);
            const TriangleEdges<F> edges = triangle_edges(ray, a, b, c);
            if (none(edges.inside)) return;
            const F t = triangle_t(ray, edges);
            const Mask<F> nearer = edges.inside & (t <= load<F>(packet.t + i)) & (t >= load<F>(packet.tmin + i));
            if (none(nearer)) return; // few candidates are left: what follows is rare
            const std::uint32_t slot = slots[lane];
            const Mask<F> self = load_int<F>(packet.source + i) == Int<F>(source_outward(static_cast<std::int32_t>(slot)));
            const Mask<F> found = nearer & later<query>(packet, i, t, query == Query::next ? scene.scene_id[slot] : 0) & !self;
            if (none(found)) return;
            take<query>(scene, packet, i, t, slot, found);
            hit_any = true;
        });
    }
    return hit_any;
}

/// Tests the vectors in `vectors` against the leaf; true when some ray's t changed.
template <Query query, FloatBatch F>
bool hit_leaf(const SceneView& scene, Packet<F>& packet, std::uint32_t vectors, std::uint64_t child) {
    using S = Scalar<F>;
    const auto kind = static_cast<PrimitiveKind>((child >> child_kind_shift) & child_kind_mask);
    const auto count = static_cast<std::uint32_t>((child >> child_count_shift) & child_count_mask) + 1u;
    const auto first_slot = static_cast<std::uint32_t>(child);
    if (is_of_triangles(child)) {
        const std::uint64_t offset = ((child >> child_block_shift) & child_block_mask) * 64u;
        return hit_triangles<query>(scene, packet, vectors, reinterpret_cast<const float*>(scene.arena + offset),
                                    triangle_slots(scene, child), count);
    }
    bool hit_any = false;
    for (std::uint32_t slot = first_slot; slot < first_slot + count; ++slot) {
        if (kind == PrimitiveKind::sphere) {
            const SphereRecord& sphere = sphere_at(scene, slot);
            const Vec3<F> centre = splat<F>(sphere.centre);
            for_each_bit(vectors, [&](std::uint32_t vector) {
                const std::uint32_t i = vector * width<F>;
                const Crossing<F> ends =
                    cross_sphere(packet.origin(i) - centre, packet.direction(i), F(S(sphere.radius)), Mask<F>(true));
                hit_any |= hit_convex<query>(scene, packet, i, ends, slot);
            });
        } else {
            const AffineRecord& affine = scene.affines[affine_index(scene, slot)];
            for_each_bit(vectors, [&](std::uint32_t vector) {
                const std::uint32_t i = vector * width<F>;
                const Vec3<F> o = point_to_object(affine, packet.origin(i));
                const Vec3<F> d = direction_to_object(affine, packet.direction(i));
                const Crossing<F> ends = kind == PrimitiveKind::ellipsoid ? cross_sphere(o, d, F(1), Mask<F>(true))
                                                                          : cross_cylinder(o, d, Mask<F>(true)).ends;
                hit_any |= hit_convex<query>(scene, packet, i, ends, slot);
            });
        }
    }
    return hit_any;
}

/// Planes are in no tree: every packet meets all of them.
template <Query query, FloatBatch F>
void hit_planes(const SceneView& scene, Packet<F>& packet) {
    for (std::uint32_t slot = first_slot(scene, PrimitiveKind::plane); slot < end_slot(scene, PrimitiveKind::plane); ++slot) {
        const PlaneRecord& plane = plane_at(scene, slot);
        for (int vector = 0; vector < packet.vectors; ++vector) {
            const std::uint32_t i = static_cast<std::uint32_t>(vector) * width<F>;
            const F t = plane_t(plane, packet.origin(i), packet.direction(i));
            const Mask<F> self = load_int<F>(packet.source + i) == Int<F>(source_outward(static_cast<std::int32_t>(slot)));
            const Mask<F> found = (t <= load<F>(packet.t + i)) & later<query>(packet, i, t, scene.scene_id[slot]) & !self;
            if (any(found)) take<query>(scene, packet, i, t, slot, found);
        }
    }
}

} // namespace lanecast::inline LANECAST_ISA
