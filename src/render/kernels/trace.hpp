#pragma once
// The one entry for a batch of rays of any kind: grouped by octant and dominant axis, traced as packets, results where the rays
// are.

#include "render/kernels/traverse.hpp"

#include "render/kernel_table.hpp"

namespace lanecast::inline LANECAST_ISA {

inline constexpr std::uint32_t max_batch_rays = 1024;

template <FloatBatch F>
struct TraceScratch {
    static constexpr std::uint32_t stride = max_batch_rays + width<F>; ///< compression stores whole vectors

    Packet<F> packet;
    std::int32_t rays_of[packet_keys][stride]; ///< the rays of each key, ascending
};

namespace detail {

/// The numbers of rays that all have one key.
struct Ascending {
    std::int32_t of[max_batch_rays]{};
    constexpr Ascending() {
        for (std::uint32_t i = 0; i < max_batch_rays; ++i) of[i] = static_cast<std::int32_t>(i);
    }
};
inline constexpr Ascending ascending;

/// The key that all rays have, as those of a coherent batch mostly do, in a third of the operations of finding every key. -1:
/// they have not, or a component is 0 or ties.
template <FloatBatch F>
LANECAST_INLINE std::int32_t shared_key(const RayBatch<F>& rays, std::uint32_t n) {
    using S = Scalar<F>;
    if (n % width<F> != 0) return -1;
    const std::int32_t key = packet_key<S>({rays.dir[0][0], rays.dir[1][0], rays.dir[2][0]});
    const Axes axes = axes_of(key >> 3);
    const auto along = [&](int axis) { return F(S((key >> axis & 1) != 0 ? -1 : 1)); };
    const F along_x = along(axes.kx), along_y = along(axes.ky), along_z = along(axes.kz);
    for (std::uint32_t i = 0; i < n; i += width<F>) {
        const F x = load<F>(rays.dir[axes.kx] + i) * along_x, y = load<F>(rays.dir[axes.ky] + i) * along_y,
                z = load<F>(rays.dir[axes.kz] + i) * along_z;
        if (!all((min(x, y) > F(0)) & (z > max(x, y)))) return -1;
    }
    return key;
}

/// Writes the rays of every key to scratch.rays_of, their numbers to counts. Returns the keys that some ray has, bit by bit.
template <FloatBatch F>
LANECAST_INLINE std::uint32_t sort_by_key(TraceScratch<F>& scratch, const RayBatch<F>& rays, std::uint32_t n,
                                          std::uint32_t (&counts)[packet_keys]) {
    constexpr std::uint32_t W = width<F>;
    Int<F> index = load_int<F>(ascending.of);
    std::uint32_t keys = 0, latest = 0;
    for (std::uint32_t i = 0; i < n; i += W) {
        const Int<F> key_of = packet_key<F>(load<F>(rays.dir, i));
        if (keys != 0 && i + W <= n && all(key_of == Int<F>(static_cast<std::int32_t>(latest)))) { // coherent rays: as before
            store(scratch.rays_of[latest] + counts[latest], index);
            counts[latest] += W;
        } else {
            for_each_unique<F>(key_of, first_lanes<F>(n - i), [&](std::int32_t key, Mask<F> lanes) {
                latest = static_cast<std::uint32_t>(key);
                if ((keys >> latest & 1u) == 0) counts[latest] = 0;
                keys |= 1u << latest;
                compress_store_int<F>(scratch.rays_of[latest] + counts[latest], index, lanes);
                counts[latest] += count_bits(bits(lanes));
            });
        }
        index = index + Int<F>(static_cast<std::int32_t>(W));
    }
    return keys;
}

/// Runs body.operator()<B>(place, ray) for the rays in `list`: with B = F where a vector of them lie side by side, as
/// coherent ones do, otherwise one by one, with B = Scalar<F>.
template <FloatBatch F, class Body>
LANECAST_INLINE void for_each_run(const std::int32_t* list, std::uint32_t count, Body&& body) {
    constexpr std::uint32_t W = width<F>;
    for (std::uint32_t place = 0; place < count; place += W) {
        const auto first = static_cast<std::uint32_t>(list[place]);
        if (place + W <= count && static_cast<std::uint32_t>(list[place + W - 1]) == first + W - 1) {
            body.template operator()<F>(place, first);
            continue;
        }
        const std::uint32_t end = place + W < count ? place + W : count;
        for (std::uint32_t k = place; k < end; ++k) body.template operator()<Scalar<F>>(k, static_cast<std::uint32_t>(list[k]));
    }
}

/// The rays in `list` into a packet.
template <FloatBatch F>
LANECAST_INLINE void gather_packet(Packet<F>& packet, const RayBatch<F>& rays, const std::int32_t* list, std::uint32_t count) {
    packet.count = count;
    for_each_run<F>(list, count, [&]<class B>(std::uint32_t place, std::uint32_t ray) {
        for (int axis = 0; axis < 3; ++axis) {
            store(packet.org[axis] + place, load<B>(rays.org[axis] + ray));
            store(packet.dir[axis] + place, load<B>(rays.dir[axis] + ray));
        }
        store(packet.source + place, load_int<B>(rays.source + ray));
        store(packet.tmin + place, rays.tmins ? load<B>(rays.tmins + ray) : B(rays.tmin));
        store(packet.t + place, rays.tmaxs ? load<B>(rays.tmaxs + ray) : B(rays.tmax));
        if (rays.after) store(packet.after + place, load_int<B>(rays.after + ray));
    });
}

template <FloatBatch F>
LANECAST_INLINE void scatter_packet(const Packet<F>& packet, const RayBatch<F>& rays, const std::int32_t* list) {
    for_each_run<F>(list, packet.count, [&]<class B>(std::uint32_t place, std::uint32_t ray) {
        store(rays.t + ray, load<B>(packet.t + place));
        store(rays.slot + ray, load_int<B>(packet.slot + place));
    });
}

} // namespace detail

/// Fills t and slot of the first n (<= max_batch_rays) rays; Query::any: some hit's slot.
template <Query query, FloatBatch F>
void trace(const SceneView& scene, const RayBatch<F>& rays, std::uint32_t n, bool brute_force, TraceScratch<F>& scratch,
           RayKindStats& stats) {
    if (n == 0) return;
    const std::uint64_t started = ticks();
    std::uint32_t counts[packet_keys];
    Occupancy occupancy{};
    const auto trace_key = [&](std::int32_t key, const std::int32_t* list, std::uint32_t count) {
        for (std::uint32_t begin = 0; begin < count; begin += Packet<F>::capacity) {
            const std::uint32_t left = count - begin;
            detail::gather_packet(scratch.packet, rays, list + begin, left < Packet<F>::capacity ? left : Packet<F>::capacity);
            finish_packet(scratch.packet, key, scene.max_coordinate);
            traverse_packet<query>(scene, scratch.packet, rays.occluders, brute_force, occupancy);
            detail::scatter_packet(scratch.packet, rays, list + begin);
        }
    };
    if (const std::int32_t key = detail::shared_key(rays, n); key >= 0)
        trace_key(key, detail::ascending.of, n);
    else
        for_each_bit(detail::sort_by_key(scratch, rays, n, counts), [&](std::uint32_t each) {
            trace_key(static_cast<std::int32_t>(each), scratch.rays_of[each], counts[each]);
        });
    stats.rays += n;
    stats.batches += 1;
    stats.first_lanes += occupancy.first_lanes;
    stats.first_active += occupancy.first_active;
    stats.last_lanes += occupancy.last_lanes;
    stats.last_active += occupancy.last_active;
    stats.ticks += ticks() - started;
}

} // namespace lanecast::inline LANECAST_ISA
