#pragma once
// Rays that have a point or a direction in common, as cameras, lamps and the sun send them, are points of a plane: seen from that
// point, or along that direction. There the rays of a vector lie in a rectangle, its footprint, which images of triangles can be
// compared with (candidates.hpp).

#include "render/kernels/packet.hpp"

namespace lanecast::inline LANECAST_ISA {

namespace detail {

/// What rays 0 and `last` have in common, and so perhaps all: the origin, the direction, or the end.
template <FloatBatch F>
Common guess_common(const Packet<F>& packet, Scalar<F> (&apex)[3]) {
    using S = Scalar<F>;
    const auto [kx, ky, kz] = packet.axes;
    const int axis[3] = {kx, ky, kz};
    const std::uint32_t last = packet.count - 1;
    for (int k = 0; k < 3; ++k) apex[k] = packet.org[axis[k]][0];
    if (packet.common_origin) return Common::point;
    if (packet.shear[0][0] == packet.shear[0][last] && packet.shear[1][0] == packet.shear[1][last]) return Common::direction;
    if (!(packet.first_tmax < S(1e18))) return Common::nothing;
    for (int k = 0; k < 3; ++k) apex[k] = apex[k] + packet.first_tmax * packet.dir[axis[k]][0];
    const S z = packet.org[kz][last] - apex[2];
    const S x = (packet.org[kx][last] - apex[0]) - packet.shear[0][last] * z;
    const S y = (packet.org[ky][last] - apex[1]) - packet.shear[1][last] * z;
    return max(abs(x), abs(y)) <= S(1e-4) * abs(z) ? Common::point : Common::nothing;
}

/// Where the rays pass the apex, in its plane of constant z; range and slack. False: they neither have its direction nor meet it.
template <FloatBatch F>
bool pass_apex(const Packet<F>& packet, Footprints<F>& prints, Scalar<F> (&passes)[2][Packet<F>::capacity]) {
    using S = Scalar<F>;
    const S* const org[3] = {packet.org[packet.axes.kx], packet.org[packet.axes.ky], packet.org[packet.axes.kz]};
    F range(S(0)), off(S(0)), turn(S(0));
    for (int vector = 0; vector < packet.vectors; ++vector) {
        const std::uint32_t i = static_cast<std::uint32_t>(vector) * width<F>;
        const F z = load<F>(org[2] + i) - F(prints.apex[2]);
        range = max(abs(z), range);
#pragma GCC unroll 2
        for (int k = 0; k < 2; ++k) {
            const F from_apex = load<F>(org[k] + i) - F(prints.apex[k]);
            const F shear = load<F>(packet.shear[k] + i);
            const F pass = from_apex - shear * z;
            store(passes[k] + i, pass);
            range = max(abs(from_apex), range);
            off = max(abs(pass), off);
            turn = max(abs(shear - F(packet.shear[k][0])), turn);
        }
    }
    prints.range = reduce_max(range);
    if (prints.common == Common::direction) return reduce_max(turn) == S(0);
    prints.slack = reduce_max(off) + S(4.8e-7) * prints.range; // its own rounding: 8 u
    return prints.slack <= S(1e-4) * prints.range;
}

/// The least and the largest lane of each of n vectors, for up to packet_vectors (the last one's stand for those beyond n). Pairs
/// are folded until one vector holds a lane of each.
template <FloatBatch F>
void bound_each(const Scalar<F>* vectors, std::uint32_t n, Scalar<F>* lo, Scalar<F>* hi) {
    constexpr std::uint32_t W = width<F>;
    for (std::uint32_t group = 0; group < packet_vectors<F>; group += W) {
        const auto at = [&](std::uint32_t i) { return load<F>(vectors + (group + i < n ? group + i : n - 1) * W); };
        F least[W / 2], largest[W / 2];
#pragma GCC unroll 8
        for (std::uint32_t i = 0; i < W / 2; ++i) {
            const F a = at(2 * i), b = at(2 * i + 1);
            const F e = evens(a, b), o = odds(a, b);
            least[i] = min(e, o);
            largest[i] = max(e, o);
        }
#pragma GCC unroll 3
        for (std::uint32_t left = W / 4; left > 0; left /= 2) {
#pragma GCC unroll 4
            for (std::uint32_t i = 0; i < left; ++i) {
                least[i] = min(evens(least[2 * i], least[2 * i + 1]), odds(least[2 * i], least[2 * i + 1]));
                largest[i] = max(evens(largest[2 * i], largest[2 * i + 1]), odds(largest[2 * i], largest[2 * i + 1]));
            }
        }
        store(lo + group, least[0]);
        store(hi + group, largest[0]);
    }
}

} // namespace detail

/// Fills packet.prints from the rays.
template <FloatBatch F>
void find_footprints(Packet<F>& packet) {
    using S = Scalar<F>;
    Footprints<F>& prints = packet.prints;
    S passes[2][Packet<F>::capacity];
    prints.range = prints.slack = prints.reach = 0;
    prints.common = detail::guess_common(packet, prints.apex);
    if (prints.common == Common::nothing) return;
    if (!packet.common_origin && !detail::pass_apex(packet, prints, passes)) {
        prints.common = Common::nothing;
        return;
    }
    const bool point = prints.common == Common::point;
    for (int k = 0; k < 2; ++k) {
        detail::bound_each<F>(point ? packet.shear[k] : passes[k], static_cast<std::uint32_t>(packet.vectors), prints.lo[k],
                              prints.hi[k]);
        F least = load<F>(prints.lo[k]), largest = load<F>(prints.hi[k]);
        for (int v = width<F>; v < packet_vectors<F>; v += width<F>) {
            least = min(load<F>(prints.lo[k] + v), least);
            largest = max(load<F>(prints.hi[k] + v), largest);
        }
        const S end = reduce_max(largest), middle = S(0.5) * (reduce_min(least) + end);
        prints.shear[k] = point ? middle : packet.shear[k][0];
        prints.offset[k] = point ? S(0) : middle;
        for (int v = 0; v < packet_vectors<F>; v += width<F>) {
            store(prints.lo[k] + v, load<F>(prints.lo[k] + v) - F(middle));
            store(prints.hi[k] + v, load<F>(prints.hi[k] + v) - F(middle));
        }
        prints.reach = max(prints.reach, end - middle);
    }
}

} // namespace lanecast::inline LANECAST_ISA
