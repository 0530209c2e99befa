#pragma once
// What the traversals of packets share: the stack, and the rays that go on alone.

#include "render/kernels/traverse_single.hpp"

namespace lanecast::inline LANECAST_ISA {

/// A subtree that this many rays or fewer enter is walked by each of them alone. Measured: docs/performance.md.
inline constexpr std::uint32_t few_rays = 8;

/// The rays of a packet that enter a subtree.
struct Entering {
    std::uint32_t vectors; ///< bit v: some ray of vector v
    std::uint32_t count;   ///< of the rays when they are few; 0: many, only `vectors` is known
    std::uint8_t rays[few_rays];
};

/// The rays of `vectors`, lanes_of[v] of each, should they be few in all.
template <FloatBatch F>
LANECAST_INLINE void list_few(Entering& entering, const std::uint32_t* lanes_of, std::uint32_t count) {
    if (count > few_rays) return;
    for_each_bit(entering.vectors, [&](std::uint32_t vector) {
        for_each_bit(lanes_of[vector], [&](std::uint32_t lane) {
            entering.rays[entering.count++] = static_cast<std::uint8_t>(vector * width<F> + lane);
        });
    });
}

/// The few rays, one by one. Returns the vectors in which some ray's t changed.
template <Query query, FloatBatch F>
std::uint32_t traverse_alone(const SceneView& scene, Packet<F>& packet, const Entering& rays, std::uint64_t child) {
    std::uint32_t changed = 0;
    for (std::uint32_t k = 0; k < rays.count; ++k) {
        const std::uint32_t i = rays.rays[k];
        if (packet.t[i] < Scalar<F>(0)) continue;
        const std::uint32_t vector = i / width<F>;
        SingleRay<F> ray(packet, i);
        if (!traverse_single<query>(scene, ray, packet, child) && ray.slot == packet.slot[i]) continue;
        changed |= 1u << vector;
        packet.t[i] = ray.t;
        packet.slot[i] = ray.slot;
    }
    return changed;
}

} // namespace lanecast::inline LANECAST_ISA
