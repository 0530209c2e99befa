#pragma once
// The one entry for a batch of rays of any kind: grouped by octant and dominant axis, traced as packets, results where the rays
// are.

#include "render/kernels/traverse.hpp"
#include "render/kernels/traverse_single.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr std::uint32_t max_batch_rays = 1024;

template <FloatBatch F>
struct TraceScratch {
    Packet<F> packet;
    std::uint16_t order[max_batch_rays];
    std::int32_t keys[max_batch_rays + 16];
};

namespace detail {

/// Rays first .. first + count of `rays`, by way of `order` unless it is null.
template <FloatBatch F>
void gather_packet(Packet<F>& packet, const RayBatch<F>& rays, const std::uint16_t* order, std::uint32_t first,
                   std::uint32_t count) {
    using S = Scalar<F>;
    if (order == nullptr) {
        for (std::uint32_t i = 0; i < count; i += width<F>) {
            for (int axis = 0; axis < 3; ++axis) {
                store(packet.org[axis] + i, load<F>(rays.org[axis] + first + i));
                store(packet.dir[axis] + i, load<F>(rays.dir[axis] + first + i));
            }
            store(packet.tmin + i, rays.tmins ? load<F>(rays.tmins + first + i) : F(rays.tmin));
            store(packet.t + i, rays.tmaxs ? load<F>(rays.tmaxs + first + i) : F(rays.tmax));
            store(packet.slot + i, Int<F>(-1));
            store(packet.source + i, load_int<F>(rays.source + first + i));
            if (rays.after) store(packet.after + i, load_int<F>(rays.after + first + i));
        }
        return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t ray = order[first + i];
        for (int axis = 0; axis < 3; ++axis) {
            packet.org[axis][i] = rays.org[axis][ray];
            packet.dir[axis][i] = rays.dir[axis][ray];
        }
        packet.tmin[i] = rays.tmins ? rays.tmins[ray] : S(rays.tmin);
        packet.t[i] = rays.tmaxs ? rays.tmaxs[ray] : S(rays.tmax);
        packet.slot[i] = -1;
        packet.source[i] = rays.source[ray];
        packet.after[i] = rays.after ? rays.after[ray] : -1;
    }
}

template <FloatBatch F>
void scatter_packet(const Packet<F>& packet, const RayBatch<F>& rays, const std::uint16_t* order, std::uint32_t first) {
    for (std::uint32_t i = 0; i < packet.count; ++i) {
        const std::uint32_t ray = order == nullptr ? first + i : order[first + i];
        rays.t[ray] = packet.t[i];
        rays.slot[ray] = packet.slot[i];
    }
}

} // namespace detail

/// Rays whose slopes spread wider than this share too few nodes for a packet. Measured: docs/performance.md.
template <FloatBatch F>
inline constexpr Scalar<F> max_packet_spread = Scalar<F>(1);

/// Fills t and slot of the first n (<= max_batch_rays) rays; Query::any: some hit's slot.
template <Query query, FloatBatch F>
void trace(const SceneView& scene, const RayBatch<F>& rays, std::uint32_t n, bool brute_force, TraceScratch<F>& scratch,
           RayKindStats& stats) {
    if (n == 0) return;
    const std::uint64_t begin = ticks();
    constexpr std::uint32_t W = width<F>;
    std::uint32_t group_size[32] = {};
    bool mixed = false;
    for (std::uint32_t i = 0; i < n; i += W) {
        const Int<F> key = packet_key<F>({load<F>(rays.dir[0] + i), load<F>(rays.dir[1] + i), load<F>(rays.dir[2] + i)});
        store(scratch.keys + i, key);
        mixed |= !all((key == Int<F>(scratch.keys[0])) | !first_lanes<F>(n - i));
    }
    const std::uint16_t* order = nullptr;
    if (mixed) { // counting sort: stable, so that neighbours stay neighbours
        for (std::uint32_t i = 0; i < n; ++i) ++group_size[scratch.keys[i]];
        std::uint32_t next[32], sum = 0;
        for (int key = 0; key < 32; ++key) {
            next[key] = sum;
            sum += group_size[key];
        }
        for (std::uint32_t i = 0; i < n; ++i) scratch.order[next[scratch.keys[i]]++] = static_cast<std::uint16_t>(i);
        order = scratch.order;
    } else {
        group_size[scratch.keys[0]] = n;
    }

    Occupancy occupancy{};
    std::uint32_t first = 0;
    for (int key = 0; key < 32; ++key) {
        for (const std::uint32_t end = first + group_size[key]; first < end;) {
            const std::uint32_t count = end - first < Packet<F>::capacity ? end - first : Packet<F>::capacity;
            detail::gather_packet(scratch.packet, rays, order, first, count);
            finish_packet(scratch.packet, count, key, scene.max_coordinate);
            if (scratch.packet.spread <= max_packet_spread<F> || brute_force)
                traverse_packet<query>(scene, scratch.packet, brute_force, occupancy);
            else
                traverse_singles<query>(scene, scratch.packet, occupancy);
            detail::scatter_packet(scratch.packet, rays, order, first);
            first += count;
        }
    }
    stats.rays += n;
    stats.batches += 1;
    stats.first_lanes += occupancy.first_lanes;
    stats.first_active += occupancy.first_active;
    stats.last_lanes += occupancy.last_lanes;
    stats.last_active += occupancy.last_active;
    stats.ticks += ticks() - begin;
}

} // namespace lanecast::inline LANECAST_ISA
