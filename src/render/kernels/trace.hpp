#pragma once
// The one entry for a batch of rays of any kind: grouped by octant and dominant axis, traced as packets, results where the rays
// are.

#include "render/kernels/traverse.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr std::uint32_t max_batch_rays = 1024;

/// Lanes of vector `vector` of a batch that stand in a packet from `place` on.
struct Segment {
    std::uint16_t vector, place;
    std::uint32_t lanes;
};

template <FloatBatch F>
struct TraceScratch {
    Packet<F> packet;
    Segment segments[Packet<F>::capacity + 1];
    std::int32_t keys[max_batch_rays + 16];
};

namespace detail {

/// Moves lanes to or from packet arrays: whole vectors, the common case, without shuffling.
template <FloatBatch F>
LANECAST_INLINE void pack(Scalar<F>* to, F lanes, Mask<F> mask, bool whole) {
    if (whole)
        store(to, lanes);
    else
        compress_store<F>(to, lanes, mask);
}
template <FloatBatch F>
LANECAST_INLINE void pack_int(std::int32_t* to, Int<F> lanes, Mask<F> mask, bool whole) {
    if (whole)
        store(to, lanes);
    else
        compress_store_int<F>(to, lanes, mask);
}

/// Fills the packet with rays of `key`, from vector `vector` on, which moves past those that found place. Returns the number of
/// segments.
template <FloatBatch F>
std::uint32_t gather_packet(TraceScratch<F>& scratch, const RayBatch<F>& rays, std::uint32_t n, std::int32_t key,
                            std::uint32_t& vector) {
    using S = Scalar<F>;
    constexpr std::uint32_t W = width<F>;
    Packet<F>& packet = scratch.packet;
    std::uint32_t count = 0, segments = 0;
    for (; vector * W < n; ++vector) {
        const std::uint32_t i = vector * W;
        const Mask<F> mask = (load_int<F>(scratch.keys + i) == Int<F>(key)) & first_lanes<F>(n - i);
        const std::uint32_t lanes = bits(mask);
        if (lanes == 0) continue;
        const auto taken = count_bits(lanes);
        if (count + taken > Packet<F>::capacity) break;
        const bool whole = lanes == all_lanes<F>;
        for (int axis = 0; axis < 3; ++axis) {
            pack<F>(packet.org[axis] + count, load<F>(rays.org[axis] + i), mask, whole);
            pack<F>(packet.dir[axis] + count, load<F>(rays.dir[axis] + i), mask, whole);
        }
        pack_int<F>(packet.source + count, load_int<F>(rays.source + i), mask, whole);
        pack<F>(packet.tmin + count, rays.tmins ? load<F>(rays.tmins + i) : F(S(rays.tmin)), mask, whole);
        pack<F>(packet.t + count, rays.tmaxs ? load<F>(rays.tmaxs + i) : F(S(rays.tmax)), mask, whole);
        if (rays.after) pack_int<F>(packet.after + count, load_int<F>(rays.after + i), mask, whole);
        scratch.segments[segments++] = {static_cast<std::uint16_t>(vector), static_cast<std::uint16_t>(count), lanes};
        count += taken;
    }
    packet.count = count;
    return segments;
}

template <FloatBatch F>
void scatter_packet(const TraceScratch<F>& scratch, const RayBatch<F>& rays, std::uint32_t segments) {
    const Packet<F>& packet = scratch.packet;
    for (std::uint32_t k = 0; k < segments; ++k) {
        const Segment& segment = scratch.segments[k];
        const std::uint32_t i = segment.vector * static_cast<std::uint32_t>(width<F>);
        if (segment.lanes == all_lanes<F>) {
            store(rays.t + i, load<F>(packet.t + segment.place));
            store(rays.slot + i, load_int<F>(packet.slot + segment.place));
            continue;
        }
        const Mask<F> mask = mask_from_bits<F>(segment.lanes);
        store(rays.t + i, select(mask, expand_load<F>(packet.t + segment.place, mask), load<F>(rays.t + i)));
        store(rays.slot + i, select(mask, expand_load_int<F>(packet.slot + segment.place, mask), load_int<F>(rays.slot + i)));
    }
}

} // namespace detail

/// Fills t and slot of the first n (<= max_batch_rays) rays; Query::any: some hit's slot.
template <Query query, FloatBatch F>
void trace(const SceneView& scene, const RayBatch<F>& rays, std::uint32_t n, bool brute_force, TraceScratch<F>& scratch,
           RayKindStats& stats) {
    if (n == 0) return;
    const std::uint64_t begin = ticks();
    constexpr std::uint32_t W = width<F>;
    std::uint32_t keys = 0; // bit k: some ray has key k
    for (std::uint32_t i = 0; i < n; i += W) {
        const Int<F> key = packet_key<F>(load<F>(rays.dir, i));
        store(scratch.keys + i, key);
        for_each_unique<F>(key, first_lanes<F>(n - i), [&](std::int32_t k, Mask<F>) { keys |= 1u << k; });
    }
    Occupancy occupancy{};
    for_each_bit(keys, [&](std::uint32_t key) {
        for (std::uint32_t vector = 0; vector * W < n;) {
            const std::uint32_t segments = detail::gather_packet(scratch, rays, n, static_cast<std::int32_t>(key), vector);
            if (segments == 0) break;
            finish_packet(scratch.packet, static_cast<std::int32_t>(key), scene.max_coordinate);
            traverse_packet<query>(scene, scratch.packet, rays.occluders, brute_force, occupancy);
            detail::scatter_packet(scratch, rays, segments);
        }
    });
    stats.rays += n;
    stats.batches += 1;
    stats.first_lanes += occupancy.first_lanes;
    stats.first_active += occupancy.first_active;
    stats.last_lanes += occupancy.last_lanes;
    stats.last_active += occupancy.last_active;
    stats.ticks += ticks() - begin;
}

} // namespace lanecast::inline LANECAST_ISA
