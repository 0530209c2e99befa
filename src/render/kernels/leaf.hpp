#pragma once
// The primitives of a leaf against a packet, and the rule by which a hit is taken: nearest t, ties to the smaller scene id, so
// that neither the tree nor the grouping of rays can show in the picture.

#include "render/kernels/candidates.hpp"
#include "render/kernels/cone.hpp"
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
        if (any(tied)) [[unlikely]]
            found = (found & !tied) | first_of_ties<F>(scene, packet.slot + i, bits(tied), slot);
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

/// An open cone or cylinder, met at either end that is on its side. It is part of a convex body's surface, so what the body's own
/// rays cannot meet, its side's cannot either.
template <Query query, FloatBatch F>
LANECAST_INLINE bool hit_open(const SceneView& scene, Packet<F>& packet, std::uint32_t i, const CappedCrossing<F>& crossing,
                              std::uint32_t slot) {
    const Mask<F> side0 = crossing.ends.hit & !crossing.cap0, side1 = crossing.ends.hit & !crossing.cap1;
    if (none(side0 | side1)) return false;
    const std::uint32_t id = scene.scene_id[slot];
    const Int<F> source = load_int<F>(packet.source + i);
    const Int<F> this_slot(static_cast<std::int32_t>(slot));
    const Mask<F> outward = source == source_outward(this_slot);
    const Mask<F> inward = source == source_inward(this_slot);
    const Mask<F> enters = side0 & later<query>(packet, i, crossing.ends.t0, id) & !inward;
    const F t = select(enters, crossing.ends.t0, crossing.ends.t1);
    const Mask<F> leaves = side1 & later<query>(packet, i, crossing.ends.t1, id);
    const Mask<F> found = (enters | leaves) & (!outward) & (t <= load<F>(packet.t + i));
    if (none(found)) return false;
    take<query>(scene, packet, i, t, slot, found);
    return true;
}

/// Triangle `lane` of a block, in the axes of the rays.
template <FloatBatch F>
struct TriangleVertices {
    Vec3<F> a, b, c;
};
template <FloatBatch F>
LANECAST_INLINE TriangleVertices<F> vertices_of(const Axes& axes, const float* block, std::uint32_t count, std::uint32_t lane) {
    using S = Scalar<F>;
    const auto vertex = [&](std::uint32_t v) {
        const float* const row = block + lane + 3 * v * count;
        return Vec3<F>{F(S(row[static_cast<std::uint32_t>(axes.kx) * count])),
                       F(S(row[static_cast<std::uint32_t>(axes.ky) * count])),
                       F(S(row[static_cast<std::uint32_t>(axes.kz) * count]))};
    };
    return {vertex(0), vertex(1), vertex(2)};
}

template <FloatBatch F>
LANECAST_INLINE TriangleVertices<F> less(const TriangleVertices<F>& vertices, const Vec3<F>& org) {
    return {vertices.a - org, vertices.b - org, vertices.c - org};
}

/// The rays of one vector against a triangle given from their origins: whether some ray's t changed. Of candidates most are
/// hit, and it is faster not to ask between the steps (1.1 to 1.15); of other pairs few are.
template <Query query, bool candidate, FloatBatch F>
LANECAST_INLINE bool hit_triangle(const SceneView& scene, Packet<F>& packet, std::uint32_t vector,
                                  const TriangleVertices<F>& from_org, const TriangleSlots& slots, std::uint32_t lane) {
    const std::uint32_t i = vector * width<F>;
    const Vec3<F> shear{load<F>(packet.shear[0] + i), load<F>(packet.shear[1] + i), load<F>(packet.shear[2] + i)};
    const TriangleEdges<F> edges = triangle_edges(shear, from_org.a, from_org.b, from_org.c);
    if (!candidate && none(edges.inside)) return false;
    const F t = triangle_t(shear.z, edges);
    const std::uint32_t slot = slots[lane];
    const Mask<F> nearer =
        edges.inside & (t <= load<F>(packet.t + i)) & later<query>(packet, i, t, query == Query::next ? scene.scene_id[slot] : 0);
    if (!candidate && none(nearer)) return false;
    const Mask<F> self = load_int<F>(packet.source + i) == Int<F>(source_outward(static_cast<std::int32_t>(slot)));
    const Mask<F> found = nearer & !self;
    if (!candidate && none(found)) return false;
    take<query>(scene, packet, i, t, slot, found);
    return any(found);
}

/// Of a leaf's pairs of a triangle and a vector, as many as this or fewer are all tested; of more, the candidates.
inline constexpr std::uint32_t few_pairs = 8;

/// Whether rays and triangles are to be compared by their footprints and images first.
template <FloatBatch F>
LANECAST_INLINE bool has_footprints(Packet<F>& packet, std::uint32_t pairs) {
    if (pairs <= few_pairs) return false;
    if (packet.prints.common == Common::unknown) find_footprints(packet);
    return packet.prints.common != Common::nothing;
}

template <Query query, FloatBatch F>
LANECAST_INLINE VectorSet hit_candidates(const SceneView& scene, Packet<F>& packet, VectorSet vectors, const float* block,
                                         const TriangleSlots& slots, std::uint32_t count) {
    const TriangleImages<F> images(packet, block, count);
    PairList<F> list;
    images.list_pairs(packet.prints, vectors, count, list);
    VectorSet changed = 0;
    for (std::uint32_t k = 0; k < list.count; ++k) {
        const std::uint32_t vector = list.pairs[k] >> 3, lane = list.pairs[k] & 7u;
        const auto vertex = [&](std::uint32_t v) {
            return Vec3<F>{F(images.from_apex[3 * v][lane]), F(images.from_apex[3 * v + 1][lane]),
                           F(images.from_apex[3 * v + 2][lane])};
        };
        const TriangleVertices<F> from_org = packet.common_origin ? TriangleVertices<F>{vertex(0), vertex(1), vertex(2)}
                                                                  : less(vertices_of<F>(packet.axes, block, count, lane),
                                                                         packet.origin_in_axes(vector * width<F>));
        changed |= VectorSet{hit_triangle<query, true>(scene, packet, vector, from_org, slots, lane)} << vector;
    }
    return changed;
}

template <Query query, FloatBatch F>
LANECAST_INLINE VectorSet hit_triangles(const SceneView& scene, Packet<F>& packet, VectorSet vectors, const float* block,
                                        const TriangleSlots& slots, std::uint32_t count) {
    if constexpr (!ScalarBatch<F>) {
        if (has_footprints(packet, count_bits(vectors) * count))
            return hit_candidates<query>(scene, packet, vectors, block, slots, count);
    }
    VectorSet changed = 0;
    for (std::uint32_t lane = 0; lane < count; ++lane) {
        const TriangleVertices<F> vertices = vertices_of<F>(packet.axes, block, count, lane);
        for_each_bit(vectors, [&](std::uint32_t vector) {
            const TriangleVertices<F> from_org = less(vertices, packet.origin_in_axes(vector * width<F>));
            if (hit_triangle<query, false>(scene, packet, vector, from_org, slots, lane)) changed |= VectorSet{1} << vector;
        });
    }
    return changed;
}

/// Tests the vectors in `vectors` against the leaf; returns those in which some ray's t changed.
template <Query query, FloatBatch F>
VectorSet hit_leaf(const SceneView& scene, Packet<F>& packet, VectorSet vectors, std::uint64_t child) {
    using S = Scalar<F>;
    const auto kind = static_cast<PrimitiveKind>((child >> child_kind_shift) & child_kind_mask);
    const auto count = static_cast<std::uint32_t>((child >> child_count_shift) & child_count_mask) + 1u;
    const auto first_slot = static_cast<std::uint32_t>(child);
    if (is_of_triangles(child)) {
        const std::uint64_t offset = ((child >> child_block_shift) & child_block_mask) * 64u;
        return hit_triangles<query>(scene, packet, vectors, reinterpret_cast<const float*>(scene.arena + offset),
                                    triangle_slots(scene, child), count);
    }
    VectorSet changed = 0;
    for (std::uint32_t slot = first_slot; slot < first_slot + count; ++slot) {
        if (kind == PrimitiveKind::sphere) {
            const SphereRecord& sphere = sphere_at(scene, slot);
            const Vec3<F> centre = splat<F>(sphere.centre);
            for_each_bit(vectors, [&](std::uint32_t vector) {
                const std::uint32_t i = vector * width<F>;
                const Crossing<F> ends =
                    cross_sphere(packet.origin(i), centre, packet.direction(i), F(S(sphere.radius)), Mask<F>(true));
                if (hit_convex<query>(scene, packet, i, ends, slot)) changed |= VectorSet{1} << vector;
            });
        } else if (kind == PrimitiveKind::cone || kind == PrimitiveKind::open_cone) {
            const AffineRecord& affine = scene.affines[affine_index(scene, slot)];
            for_each_bit(vectors, [&](std::uint32_t vector) {
                const std::uint32_t i = vector * width<F>;
                const Vec3<F> org = packet.origin(i), dir = packet.direction(i);
                const CappedCrossing<F> crossing = cross_cone(ObjectRay<F>(affine, org, dir), Mask<F>(true));
                if (kind == PrimitiveKind::cone ? hit_convex<query>(scene, packet, i, crossing.ends, slot)
                                                : hit_open<query>(scene, packet, i, crossing, slot))
                    changed |= VectorSet{1} << vector;
            });
        } else {
            const AffineRecord& affine = scene.affines[affine_index(scene, slot)];
            for_each_bit(vectors, [&](std::uint32_t vector) {
                const std::uint32_t i = vector * width<F>;
                const Vec3<F> org = packet.origin(i), dir = packet.direction(i);
                const ObjectRay<F> ray(affine, org, dir);
                const Crossing<F> ends = kind == PrimitiveKind::ellipsoid ? cross_ellipsoid(ray, Mask<F>(true))
                                                                          : cross_cylinder(ray, Mask<F>(true)).ends;
                if (hit_convex<query>(scene, packet, i, ends, slot)) changed |= VectorSet{1} << vector;
            });
        }
    }
    return changed;
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
