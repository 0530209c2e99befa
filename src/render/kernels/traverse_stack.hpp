#pragma once
// What the traversals of packets share: the stack, and the rays that go on alone.

#include "render/kernels/traverse_single.hpp"

namespace lanecast::inline LANECAST_ISA {

/// A subtree that this many rays or fewer enter, and a quarter of their vectors' lanes or fewer, is walked by each of them alone:
/// the tests of a packet cost by the vector. Measured: docs/performance.md.
inline constexpr std::uint32_t few_rays = 16;
template <FloatBatch F>
inline constexpr std::uint32_t few_per_vector = width<F> < 8 ? (width<F> + 1) / 2 : width<F> / 4;

/// The rays of a packet that enter a subtree.
struct Entering {
    VectorSet vectors;   ///< bit v: some ray of vector v
    std::uint32_t count; ///< of the rays when they are few; 0: many, only `vectors` is known
    std::uint16_t rays[few_rays];
};

/// The rays of `vectors`, lanes_of[v] of each, should they be few in all.
template <FloatBatch F>
LANECAST_INLINE void list_few(Entering& entering, const std::uint32_t* lanes_of, std::uint32_t count) {
    if (count > few_rays || count > few_per_vector<F> * count_bits(entering.vectors)) return;
    for_each_bit(entering.vectors, [&](std::uint32_t vector) {
        for_each_bit(lanes_of[vector], [&](std::uint32_t lane) {
            entering.rays[entering.count++] = static_cast<std::uint16_t>(vector * width<F> + lane);
        });
    });
}

/// The few rays, each on its own way, in turns: while one waits for memory, others go on. Returns the vectors in which some ray's
/// t changed.
template <Query query, FloatBatch F>
VectorSet traverse_alone(const SceneView& scene, Packet<F>& packet, const Entering& rays, std::uint64_t child) {
    const PlaneOffsets planes(packet.negative);
    const bool from_far = far_first<query>(packet.common_origin);
    SingleRay<F> singles[few_rays];
    std::uint8_t going[few_rays];
    std::uint32_t count = 0;
    VectorSet changed = 0;
    for (std::uint32_t k = 0; k < rays.count; ++k) {
        if (packet.t[rays.rays[k]] < Scalar<F>(0)) continue;
        singles[count].start(packet, rays.rays[k], child);
        going[count] = static_cast<std::uint8_t>(count);
        ++count;
    }
    while (count > 0) {
        for (std::uint32_t k = 0; k < count;) {
            SingleRay<F>& ray = singles[going[k]];
            if (step<query>(scene, ray, planes, from_far)) {
                ++k;
                continue;
            }
            going[k] = going[--count];
            if (ray.t == packet.t[ray.i] && ray.slot == packet.slot[ray.i]) continue;
            changed |= VectorSet{1} << (ray.i / width<F>);
            packet.t[ray.i] = ray.t;
            packet.slot[ray.i] = ray.slot;
        }
    }
    return changed;
}

} // namespace lanecast::inline LANECAST_ISA
