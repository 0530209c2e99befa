#pragma once
// Packets through the tree: one interval test of a node's eight children for the whole packet, then each surviving child
// against each vector that is still in its subtree; nearest child first. Where few rays are left, each goes on alone.

#include "render/kernels/traverse_stack.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
struct StackEntry {
    std::uint64_t child;
    Scalar<F> near; ///< no ray of the packet enters before; from_end: of t less its limit, so at most 0
    Entering rays;
};

/// Lanes active at the first and last test, for the statistics.
struct Occupancy {
    std::uint64_t first_lanes, first_active, last_lanes, last_active;
};

/// Bit c: some ray of the packet may enter child c, not before near[c].
template <FloatBatch F>
LANECAST_INLINE std::uint32_t enter_children(const Packet<F>& packet, const BvhNode& node, Scalar<F>* near) {
    using S = Scalar<F>;
    using E = Eight<F>;
    std::uint32_t entered = 0;
    for (int c = 0; c < 8; c += width<E>) {
        E enter(packet.from_end ? -packet.t_max : S(0)), leave(packet.from_end ? S(0) : packet.t_max);
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; ++axis) {
            const E near_plane = load_eight<E>((packet.negative[axis] ? node.hi[axis] : node.lo[axis]) + c);
            const E far_plane = load_eight<E>((packet.negative[axis] ? node.lo[axis] : node.hi[axis]) + c);
            const E x = near_plane - E(packet.interval_near[axis]);
            const E y = far_plane - E(packet.interval_far[axis]);
            const E r0(packet.rcp_min[axis]), r1(packet.rcp_max[axis]);
            enter = max(min(x * r0, x * r1), enter);
            leave = min(max(y * r0, y * r1), leave);
        }
        store(near + c, enter);
        entered |= bits(enter <= leave) << c;
    }
    return entered & 0xffu;
}

/// Of the vectors in `vectors`, those with rays that may enter the child.
template <FloatBatch F>
LANECAST_INLINE Entering enter_vectors(const Packet<F>& packet, const BvhNode& node, std::uint32_t child, VectorSet vectors) {
    using S = Scalar<F>;
    F near_plane[3], far_plane[3];
    for (int axis = 0; axis < 3; ++axis) {
        near_plane[axis] = F(S(packet.negative[axis] ? node.hi[axis][child] : node.lo[axis][child]));
        far_plane[axis] = F(S(packet.negative[axis] ? node.lo[axis][child] : node.hi[axis][child]));
    }
    std::uint32_t lanes_of[packet_vectors<F>];
    std::uint32_t count = 0;
    Entering entering{};
    const auto test = [&](std::uint32_t vector, const F(&near)[3], const F(&far)[3], F enter, F leave) {
        const std::uint32_t i = vector * width<F>;
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; ++axis) {
            const F rcp = load<F>(packet.rcp[axis] + i);
            enter = max(near[axis] * rcp, enter);
            leave = min(far[axis] * rcp, leave);
        }
        const std::uint32_t lanes = bits(enter <= leave);
        lanes_of[vector] = lanes;
        count += count_bits(lanes);
        entering.vectors |= VectorSet{lanes != 0} << vector;
    };
    if (packet.common_origin || packet.from_end) { // one subtraction for all
        F near[3], far[3];
        for (int axis = 0; axis < 3; ++axis) {
            near[axis] = near_plane[axis] - F(packet.interval_near[axis]);
            far[axis] = far_plane[axis] - F(packet.interval_far[axis]);
        }
        if (packet.from_end)
            for_each_bit(vectors,
                         [&](std::uint32_t vector) { test(vector, near, far, -load<F>(packet.t + vector * width<F>), F(0)); });
        else
            for_each_bit(vectors,
                         [&](std::uint32_t vector) { test(vector, near, far, F(0), load<F>(packet.t + vector * width<F>)); });
    } else {
        for_each_bit(vectors, [&](std::uint32_t vector) {
            const std::uint32_t i = vector * width<F>;
            F near[3], far[3];
            for (int axis = 0; axis < 3; ++axis) {
                near[axis] = near_plane[axis] - load<F>(packet.org_near[axis] + i);
                far[axis] = far_plane[axis] - load<F>(packet.org_far[axis] + i);
            }
            test(vector, near, far, F(0), load<F>(packet.t + i));
        });
    }
    list_few<F>(entering, lanes_of, count);
    return entering;
}

template <FloatBatch F>
LANECAST_INLINE void update_t_max(Packet<F>& packet) {
    F t_max(Scalar<F>(-1));
    for (int vector = 0; vector < packet.vectors; ++vector)
        t_max = max(t_max, load<F>(packet.t + static_cast<std::uint32_t>(vector) * width<F>));
    packet.t_max = reduce_max(t_max);
}

/// Rays of `vectors` whose question is still open.
template <FloatBatch F>
LANECAST_INLINE std::uint32_t count_open(const Packet<F>& packet, VectorSet vectors) {
    std::uint32_t rays = 0;
    for_each_bit(vectors, [&](std::uint32_t vector) { rays += count_bits(bits(load<F>(packet.t + vector * width<F>) >= F(0))); });
    return rays;
}

/// Takes the vectors out of `open` that have changed and have no open ray left.
template <FloatBatch F>
LANECAST_INLINE void close_answered(const Packet<F>& packet, VectorSet changed, VectorSet& open) {
    for_each_bit(changed, [&](std::uint32_t vector) {
        open &= ~(VectorSet{none(load<F>(packet.t + vector * width<F>) >= F(0))} << vector);
    });
}

/// Tries what hid the light from the packets before. A leaf that now answers fewer than one ray in sixteen is forgotten.
template <FloatBatch F>
void try_occluders(const SceneView& scene, Packet<F>& packet, Occluders& occluders, VectorSet& open) {
    std::uint32_t open_rays = count_open(packet, open);
    for (std::uint32_t k = 0; k < occluders.count && open != 0;) {
        close_answered(packet, hit_leaf<Query::any>(scene, packet, open, occluders.leaf[k]), open);
        const std::uint32_t before = open_rays;
        open_rays = count_open(packet, open);
        if ((before - open_rays) * 16 < packet.count)
            forget(occluders, k);
        else
            ++k;
    }
}

/// Remembers a leaf that has just answered a quarter of the rays. Measured, AVX-512, best against best: San Miguel, rays to a
/// directional light 1.7 times as many, to a point light 1.3; Sponza 1.35 and 1.5; others 1.0.
template <FloatBatch F>
LANECAST_INLINE void note_occluder(const Packet<F>& packet, Occluders& occluders, std::uint64_t leaf, VectorSet changed,
                                   std::uint32_t& open_rays) {
    if (packet.count < 32 || count_bits(changed) * 4 < static_cast<std::uint32_t>(packet.vectors)) return;
    const std::uint32_t before = open_rays;
    open_rays = count_open(packet, packet.all_vectors());
    if ((before - open_rays) * 4 >= packet.count) remember(occluders, leaf);
}

/// Every bounded primitive, in order of nearness as far as the boxes tell. Returns the vectors of the last leaf tested.
template <Query query, FloatBatch F>
VectorSet traverse_tree(const SceneView& scene, Packet<F>& packet, Occluders* occluders) {
    VectorSet last = packet.all_vectors();
    // Query::any: the vectors with open questions, and how many these are. Otherwise packet.t_max tells what is left to do.
    VectorSet open = last;
    std::uint32_t open_rays = 0;
    if constexpr (query == Query::any) {
        if (occluders != nullptr) {
            if (occluders->count > 0) try_occluders(scene, packet, *occluders, open);
            if (open == 0) return last;
            open_rays = count_open(packet, open);
        }
        look_from_end(packet, scene.max_coordinate);
    }
    const bool from_far = far_first<query>(packet.common_origin);
    StackEntry<F> stack[stack_capacity];
    int top = 0;
    stack[top++] = {0, 0, {open, 0, {}}};
    alignas(64) Scalar<F> near[16];
    while (top > 0) {
        StackEntry<F> entry = stack[--top];
        if (query == Query::any ? (entry.rays.vectors &= open) == 0 : entry.near > packet.t_max) continue;
        const bool leaf = (entry.child & child_is_leaf) != 0;
        if (leaf || entry.rays.count > 0) {
            last = entry.rays.vectors;
            const VectorSet changed = entry.rays.count > 0 ? traverse_alone<query>(scene, packet, entry.rays, entry.child)
                                                           : hit_leaf<query>(scene, packet, entry.rays.vectors, entry.child);
            if (changed == 0) continue;
            if constexpr (query == Query::any) {
                close_answered(packet, changed, open);
                if (occluders != nullptr && leaf) note_occluder(packet, *occluders, entry.child, changed, open_rays);
                if (open == 0) break;
            } else {
                update_t_max(packet);
            }
            continue;
        }
        const auto& node = *reinterpret_cast<const BvhNode*>(scene.arena + entry.child * 64u);
        const int first_pushed = top;
        for_each_bit(enter_children(packet, node, near), [&](std::uint32_t c) {
            const Entering entering = enter_vectors(packet, node, c, entry.rays.vectors);
            if (entering.vectors == 0) return;
            prefetch(scene, node.child[c]);
            // insertion by distance, what is tried first on top
            int place = top++;
            for (; place > first_pushed && (from_far ? stack[place - 1].near > near[c] : stack[place - 1].near < near[c]);
                 --place)
                stack[place] = stack[place - 1];
            stack[place] = {node.child[c], near[c], entering};
        });
    }
    return last;
}

template <Query query, FloatBatch F>
void traverse_packet(const SceneView& scene, Packet<F>& packet, Occluders* occluders, bool brute_force, Occupancy& occupancy) {
    occupancy.first_lanes += static_cast<std::uint64_t>(packet.vectors) * width<F>;
    occupancy.first_active += packet.count;
    hit_planes<query>(scene, packet);
    VectorSet last = packet.all_vectors();
    if ((scene.features & feature_planes) != 0) update_t_max(packet);
    if (scene.leaf_count != 0 && brute_force) {
        for (std::uint32_t leaf = 0; leaf < scene.leaf_count; ++leaf) hit_leaf<query>(scene, packet, last, scene.leaves[leaf]);
    } else if (scene.leaf_count != 0 && packet.t_max >= Scalar<F>(0)) {
        last = traverse_tree<query>(scene, packet, occluders);
    }
    for_each_bit(last, [&](std::uint32_t vector) {
        const std::uint32_t i = vector * width<F>;
        occupancy.last_lanes += width<F>;
        occupancy.last_active += count_bits(bits(load<F>(packet.t + i) >= F(0)));
    });
}

} // namespace lanecast::inline LANECAST_ISA
