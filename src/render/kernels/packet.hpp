#pragma once
// A packet: up to 64 vectors of rays of one octant and one dominant axis, with everything traversal reads, and the intervals
// that bound all of them.

#include "render/kernels/rays.hpp"
#include "render/kernels/triangle.hpp"

namespace lanecast::inline LANECAST_ISA {

/// Bit v: vector v of a packet.
using VectorSet = std::uint64_t;

/// Of a full packet: as many as a set has bits, and 512 rays. The more, the fewer times a node is tested and a leaf's triangles
/// are prepared for them; twice as many rays gained no more. Measured against 16: docs/performance.md.
template <FloatBatch F>
inline constexpr int packet_vectors = width<F> < 8 ? 64 : 512 / width<F>;

/// What the rays of a packet have in common.
enum class Common : std::uint8_t { unknown, nothing, point, direction };

/// The rays of a packet as points of a plane, in its axes (footprints.hpp). With d = v - apex, the point v of the scene has the
/// image (d.x - shear.x d.z - offset.x, d.y - shear.y d.z - offset.y, w), homogeneous: w = d.z as seen from a point, 1 along a
/// direction. The middle of all rays is at 0.
template <FloatBatch F>
struct Footprints {
    using S = Scalar<F>;
    Common common;
    S apex[3], shear[2], offset[2];
    S lo[2][packet_vectors<F>], hi[2][packet_vectors<F>]; ///< of each vector's rays
    S reach;                                              ///< the largest |x|, |y| of all rays
    S range;                                              ///< largest distance of an origin from the apex along one axis
    S slack;                                              ///< how far from the apex, along x or y, a ray may pass
};

template <FloatBatch F>
struct Packet {
    using S = Scalar<F>;
    static constexpr std::uint32_t capacity = packet_vectors<F> * width<F>;
    static constexpr std::uint32_t stride = capacity + width<F>; ///< no power of two: arrays 4096 bytes apart share cache lines

    alignas(64) S org[3][stride];
    S dir[3][stride];
    // Slabs: a box is entered at max((near - org_near) * rcp), left at min((far - org_far) * rcp). The origins are moved apart by
    // 16 u (|org| + M), |org| its largest component, for a body's matrix turns the rounding of one into others, and M the scene's
    // largest coordinate. This covers the rounding of the slab test (6 u), that of the sheared vertices (3 u) and of the
    // quadrics' t: no box of a true hit is missed, at no cost per box (docs/numerics.md).
    S org_near[3][stride]; ///< with a common origin only the first vector's
    S org_far[3][stride];
    S rcp[3][stride];
    S shear[3][stride]; ///< (dir[kx], dir[ky], 1) / dir[kz]
    S tmin[stride];
    S t[stride]; ///< nearest so far; -1: a lane without a ray, or whose question is answered
    std::int32_t slot[stride];
    std::int32_t source[stride];
    std::int32_t after[stride];

    int vectors;
    std::uint32_t count; ///< rays; the lanes beyond repeat the last one with t = -1
    Axes axes;
    bool negative[3];   ///< of the directions
    bool common_origin; ///< every ray starts at the same point
    bool from_end;      ///< boxes are met from the point where every ray ends: see look_from_end

    // Over all rays: the origins and reciprocal directions that bound entry from below and exit from above. With from_end the
    // point where they end instead of the origins.
    S interval_near[3], interval_far[3];
    S rcp_min[3], rcp_max[3];
    S t_max;      ///< largest t
    S first_tmax; ///< of ray 0
    Footprints<F> prints;

    [[nodiscard]] LANECAST_INLINE VectorSet all_vectors() const { return ~VectorSet(0) >> (64 - vectors); }
    [[nodiscard]] LANECAST_INLINE Vec3<F> origin_in_axes(std::uint32_t i) const {
        return {load<F>(org[axes.kx] + i), load<F>(org[axes.ky] + i), load<F>(org[axes.kz] + i)};
    }
    [[nodiscard]] LANECAST_INLINE Vec3<F> origin(std::uint32_t i) const {
        return {load<F>(org[0] + i), load<F>(org[1] + i), load<F>(org[2] + i)};
    }
    [[nodiscard]] LANECAST_INLINE Vec3<F> direction(std::uint32_t i) const {
        return {load<F>(dir[0] + i), load<F>(dir[1] + i), load<F>(dir[2] + i)};
    }
};

inline constexpr std::uint32_t packet_keys = 24;

/// Of a ray's origin and direction together, the sum of all |components|. Unused children of nodes have boxes at 1e30, the wrong
/// way round, which an origin that is moved apart by less cannot enter.
inline constexpr float largest_ray = 1e34f;

/// Octant in bits 0 to 2 (sign bits of x, y, z), dominant axis in bits 3 and 4: rays of one key may share a packet.
template <FloatBatch F>
LANECAST_INLINE Int<F> packet_key(const Vec3<F>& d) {
    const Vec3<F> a = abs(d);
    const Mask<F> y_wins = a.y > a.x;
    const Mask<F> z_wins = a.z > max(a.x, a.y);
    const Int<F> axis = select(z_wins, Int<F>(16), select(y_wins, Int<F>(8), Int<F>(0)));
    return axis | select(d.x < F(0), Int<F>(1), Int<F>(0)) | select(d.y < F(0), Int<F>(2), Int<F>(0)) |
           select(d.z < F(0), Int<F>(4), Int<F>(0));
}

namespace detail {

/// Gives the lanes that are not valid a harmless direction of the packet's key, and nothing to look for.
template <FloatBatch F>
void kill_lanes(Packet<F>& packet, std::uint32_t i, Mask<F> valid) {
    using S = Scalar<F>;
    for (int axis = 0; axis < 3; ++axis) {
        const S slope = (axis == packet.axes.kz ? S(1) : S(0.5)) * (packet.negative[axis] ? S(-1) : S(1));
        store(packet.org[axis] + i, select(valid, load<F>(packet.org[axis] + i), F(0)));
        store(packet.dir[axis] + i, select(valid, load<F>(packet.dir[axis] + i), F(slope)));
    }
    store(packet.t + i, select(valid, load<F>(packet.t + i), F(S(-1))));
}

/// Whether all of the first n rays start where ray 0 does.
template <FloatBatch F>
LANECAST_INLINE bool share_origin(const Packet<F>& packet, std::uint32_t n) {
    Mask<F> same(true);
    for (std::uint32_t i = 0; i < n; i += width<F>)
        for (int axis = 0; axis < 3; ++axis) same = same & (load<F>(packet.org[axis] + i) == F(packet.org[axis][0]));
    return all(same);
}

/// Fills the derived arrays of the first n rays, and the intervals. With `common` all start at one point, which is moved apart
/// once; false if a ray among them is not valid.
template <bool common, FloatBatch F>
LANECAST_INLINE bool derive_rays(Packet<F>& packet, std::uint32_t n, float max_coordinate) {
    using S = Scalar<F>;
    const int kz = packet.axes.kz;
    const F infinity(std::numeric_limits<S>::infinity());
    // Along the direction of travel, so that both signs are one code: near planes bound from below, far planes from above.
    F near_bound[3], far_bound[3], rcp_min[3], rcp_max[3], along[3];
    for (int axis = 0; axis < 3; ++axis) {
        along[axis] = F(packet.negative[axis] ? S(-1) : S(1));
        near_bound[axis] = -infinity;
        far_bound[axis] = infinity;
        rcp_min[axis] = infinity;
        rcp_max[axis] = -infinity;
    }
    const auto move_apart = [&](std::uint32_t i) {
        const F farthest =
            max(max(abs(load<F>(packet.org[0] + i)), abs(load<F>(packet.org[1] + i))), abs(load<F>(packet.org[2] + i)));
        const F apart_by = (farthest + F(S(max_coordinate))) * F(S(9.6e-7)); // 16 u
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; ++axis) {
            const F o = load<F>(packet.org[axis] + i);
            const F away = along[axis] * apart_by;
            const F o_near = o + away, o_far = o - away;
            store(packet.org_near[axis] + i, o_near);
            store(packet.org_far[axis] + i, o_far);
            near_bound[axis] = max(near_bound[axis], along[axis] * o_near);
            far_bound[axis] = min(far_bound[axis], along[axis] * o_far);
        }
    };
    const auto length_of = [](const S(&v)[3][Packet<F>::stride], std::uint32_t i) {
        return abs(load<F>(v[0] + i)) + abs(load<F>(v[1] + i)) + abs(load<F>(v[2] + i));
    };
    if (common) move_apart(0);
    F t_max(S(-1)), org_length = length_of(packet.org, 0);
    for (std::uint32_t i = 0; i < n; i += width<F>) {
        // A ray that is not finite hits nothing, and must not spoil the intervals of the others: it becomes a dead lane. So does
        // one whose roundings exceed the boxes of nodes' unused children, and one whose reciprocals vanish.
        if (!common) org_length = length_of(packet.org, i);
        const F t = load<F>(packet.t + i);
        const Mask<F> valid =
            (org_length + length_of(packet.dir, i) <= F(S(largest_ray))) & (abs(load<F>(packet.dir[kz] + i)) > F(0)) & (t == t);
        if (!all(valid)) {
            if (common) return false;
            detail::kill_lanes(packet, i, valid);
        }

        store(packet.slot + i, Int<F>(-1));
        const F dz = load<F>(packet.dir[kz] + i);
        const F inv_dz = F(1) / dz;
        store(packet.shear[0] + i, load<F>(packet.dir[packet.axes.kx] + i) * inv_dz);
        store(packet.shear[1] + i, load<F>(packet.dir[packet.axes.ky] + i) * inv_dz);
        store(packet.shear[2] + i, inv_dz);
        // a direction component is at least 2^-60 of the largest, so that 0 * infinity cannot arise
        const F least = abs(dz) * F(S(8.7e-19));
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; ++axis) {
            const F d = load<F>(packet.dir[axis] + i);
            const F rcp = axis == kz ? inv_dz : F(1) / copysign(max(abs(d), least), along[axis]);
            store(packet.rcp[axis] + i, rcp);
            rcp_min[axis] = min(rcp_min[axis], rcp);
            rcp_max[axis] = max(rcp_max[axis], rcp);
        }
        if (!common) move_apart(i);
        t_max = max(t_max, load<F>(packet.t + i));
    }
    packet.t_max = reduce_max(t_max);
    for (int axis = 0; axis < 3; ++axis) {
        packet.rcp_min[axis] = reduce_min(rcp_min[axis]);
        packet.rcp_max[axis] = reduce_max(rcp_max[axis]);
        packet.interval_near[axis] = packet.negative[axis] ? -reduce_max(near_bound[axis]) : reduce_max(near_bound[axis]);
        packet.interval_far[axis] = packet.negative[axis] ? -reduce_min(far_bound[axis]) : reduce_min(far_bound[axis]);
    }
    return true;
}

} // namespace detail

/// Fills the derived arrays and intervals from org, dir, tmin, t, source of packet.count rays that share `key`.
template <FloatBatch F>
void finish_packet(Packet<F>& packet, std::int32_t key, float max_coordinate) {
    constexpr std::uint32_t W = width<F>;
    const std::uint32_t count = packet.count;
    packet.vectors = static_cast<int>((count + W - 1) / W);
    packet.axes = axes_of(key >> 3);
    for (int axis = 0; axis < 3; ++axis) packet.negative[axis] = ((key >> axis) & 1) != 0;
    const std::uint32_t padded = static_cast<std::uint32_t>(packet.vectors) * W;
    for (std::uint32_t i = count; i < padded; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            packet.org[axis][i] = packet.org[axis][count - 1];
            packet.dir[axis][i] = packet.dir[axis][count - 1];
        }
        packet.tmin[i] = 0;
        packet.t[i] = -1;
        packet.source[i] = no_source;
        packet.after[i] = -1;
    }
    packet.common_origin = detail::share_origin(packet, padded) && detail::derive_rays<true>(packet, padded, max_coordinate);
    if (!packet.common_origin) detail::derive_rays<false>(packet, padded, max_coordinate);
    packet.from_end = false;
    packet.first_tmax = packet.t[0];
    packet.prints.common = Common::unknown;
}

/// Where all rays end at one point, as shadow rays do at a lamp, boxes are met from there: with t less its limit, from -t to 0,
/// instead of t, the intervals have one origin, and a packet needs one subtraction per plane. For rays whose t is their limit
/// until they are answered.
template <FloatBatch F>
void look_from_end(Packet<F>& packet, float max_coordinate) {
    using S = Scalar<F>;
    if (packet.common_origin || !(packet.first_tmax < S(1e18))) return;
    S end[3], reach(0);
    for (int axis = 0; axis < 3; ++axis) {
        end[axis] = packet.org[axis][0] + packet.first_tmax * packet.dir[axis][0];
        reach = max(abs(end[axis]), reach);
    }
    F off(0), farthest(0);
    for (std::uint32_t i = 0; i < packet.count; i += width<F>) {
        const F t = load<F>(packet.t + i);
        const Mask<F> open = t >= F(0);
#pragma GCC unroll 3
        for (int axis = 0; axis < 3; ++axis) {
            const F o = load<F>(packet.org[axis] + i);
            off = max(select(open, abs(o + t * load<F>(packet.dir[axis] + i) - F(end[axis])), F(0)), off); // infinity stays
            farthest = max(farthest, abs(o));
        }
    }
    const S M(max_coordinate);
    reach = max(reach, reduce_max(farthest));
    const S slack = reduce_max(off) + S(4.8e-7) * reach; // 8 u: the rounding of `off`
    if (!(slack <= S(1e-4) * M) || !(reach <= S(8) * M)) return;
    packet.from_end = true;
    for (int axis = 0; axis < 3; ++axis) {
        const S away = (S(9.6e-7) * (reach + M) + slack) * (packet.negative[axis] ? S(-1) : S(1));
        packet.interval_near[axis] = end[axis] + away;
        packet.interval_far[axis] = end[axis] - away;
    }
}

} // namespace lanecast::inline LANECAST_ISA
