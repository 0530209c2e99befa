#pragma once
// Which triangles of a leaf the rays of a vector may hit, eight at a time: those whose image, as a packet with footprints sees
// it, is not proved to lie beside the vector's. Only a proposal: `triangle_edges` decides, and every bound here is moved outwards
// by more than the rounding of both.

#include "render/kernels/footprints.hpp"

namespace lanecast::inline LANECAST_ISA {

/// The numbers of the bits of a byte, one after the other, from the lowest byte on.
struct BitLists {
    std::uint64_t of[256]{};
    constexpr BitLists() {
        for (std::uint32_t byte = 0; byte < 256; ++byte) {
            std::uint32_t n = 0;
            for (std::uint64_t bit = 0; bit < 8; ++bit)
                if (((byte >> bit) & 1u) != 0) of[byte] |= bit << (8 * n++);
        }
    }
};
inline constexpr BitLists bit_lists;

using EightBytes [[gnu::vector_size(8)]] = std::uint8_t;
using EightPairs [[gnu::vector_size(16)]] = std::uint16_t;

/// Pairs of a vector and a triangle: 8 * vector + triangle each.
template <FloatBatch F>
struct PairList {
    std::uint32_t count = 0;
    std::uint16_t pairs[8 * packet_vectors<F> + 8];
};

/// Up to eight triangles of a leaf as a packet sees them.
template <FloatBatch F>
struct TriangleImages {
    using S = Scalar<F>;
    using E = Eight<F>;
    static constexpr std::uint32_t W = width<E>;
    static constexpr std::uint32_t groups = 8 / W;
    struct Group {
        E edge[3][3];   ///< edge[i][2] + x edge[i][0] + y edge[i][1] >= 0 inside; infinite where the orientation is uncertain
        E lo[2], hi[2]; ///< around the image
    };

    alignas(64) S from_apex[9][8]; ///< the vertices
    Group group[groups];

    LANECAST_INLINE TriangleImages(const Packet<F>& packet, const float* block, std::uint32_t count);
    LANECAST_INLINE void list_pairs(const Footprints<F>& prints, VectorSet vectors, std::uint32_t count, PairList<F>& list) const;

private:
    LANECAST_INLINE void fill(Group& to, const Footprints<F>& prints, E (&x)[3], E (&y)[3], E (&z)[3]) const;
};

template <FloatBatch F>
LANECAST_INLINE TriangleImages<F>::TriangleImages(const Packet<F>& packet, const float* block, std::uint32_t count) {
    const Footprints<F>& prints = packet.prints;
    const std::uint32_t row_x = static_cast<std::uint32_t>(packet.axes.kx) * count;
    const std::uint32_t row_y = static_cast<std::uint32_t>(packet.axes.ky) * count;
    const std::uint32_t row_z = static_cast<std::uint32_t>(packet.axes.kz) * count;
    const E apex_x(prints.apex[0]), apex_y(prints.apex[1]), apex_z(prints.apex[2]);
    for (std::uint32_t g = 0; g < groups && g * W < count; ++g) {
        E x[3], y[3], z[3];
#pragma GCC unroll 3
        for (std::uint32_t v = 0; v < 3; ++v) {
            const float* const vertex = block + 3 * v * count + g * W;
            x[v] = load_eight<E>(vertex + row_x) - apex_x;
            y[v] = load_eight<E>(vertex + row_y) - apex_y;
            z[v] = load_eight<E>(vertex + row_z) - apex_z;
            store(from_apex[3 * v] + g * W, x[v]);
            store(from_apex[3 * v + 1] + g * W, y[v]);
            store(from_apex[3 * v + 2] + g * W, z[v]);
        }
        fill(group[g], prints, x, y, z);
    }
}

// Errors, with Z the largest |z| from an apex or an origin, m the largest |x|, |y| of images among the rays, u = 2^-24: of
// sheared coordinates, here and in the test, 6 u (Z + m) + slack each; of edge functions 4 m times that, twice, and 30 u m^2 for
// their own products and sums: less than m (64 u (Z + m) + 8 slack). 1e-36 and 1e-18: products that were flushed to zero.
template <FloatBatch F>
LANECAST_INLINE void TriangleImages<F>::fill(Group& to, const Footprints<F>& prints, E (&x)[3], E (&y)[3], E (&z)[3]) const {
    const E infinity(std::numeric_limits<S>::infinity()), minus_infinity(-std::numeric_limits<S>::infinity());
    const bool point = prints.common == Common::point;
    const E far = max(max(abs(z[0]), abs(z[1])), abs(z[2])) + E(prints.range);
#pragma GCC unroll 3
    for (int v = 0; v < 3; ++v) {
        x[v] = x[v] - E(prints.shear[0]) * z[v] - E(prints.offset[0]);
        y[v] = y[v] - E(prints.shear[1]) * z[v] - E(prints.offset[1]);
    }
    E wide = max(max(max(abs(x[0]), abs(x[1])), abs(x[2])), max(max(abs(y[0]), abs(y[1])), abs(y[2])));
    wide = wide + (point ? far : E(S(1))) * E(prints.reach);
    if (!point) z[0] = z[1] = z[2] = E(S(1));
    const E error = wide * (E(S(3.9e-6)) * (far + wide) + E(S(8) * prints.slack)) + E(S(1e-36));
    const Mask<E> finite = error < E(S(1e30));

    E sum_x(S(0)), sum_y(S(0)), sum_z(S(0));
#pragma GCC unroll 3
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t p = (i + 2) % 3, q = (i + 1) % 3;
        to.edge[i][0] = y[p] * z[q] - z[p] * y[q];
        to.edge[i][1] = z[p] * x[q] - x[p] * z[q];
        to.edge[i][2] = x[p] * y[q] - y[p] * x[q];
        sum_x = sum_x + to.edge[i][0];
        sum_y = sum_y + to.edge[i][1];
        sum_z = sum_z + to.edge[i][2];
    }
    const Mask<E> oriented = finite & (abs(sum_z) > E(prints.reach) * (abs(sum_x) + abs(sum_y)) + E(S(4)) * error);
    const E side = copysign(E(S(1)), sum_z);
#pragma GCC unroll 3
    for (std::uint32_t i = 0; i < 3; ++i) {
        to.edge[i][0] = to.edge[i][0] * side;
        to.edge[i][1] = to.edge[i][1] * side;
        to.edge[i][2] = select(oriented, to.edge[i][2] * side + error, infinity);
    }

    const Mask<E> one_side = (min(min(z[0], z[1]), z[2]) > E(S(0))) | (max(max(z[0], z[1]), z[2]) < E(S(0)));
    const Mask<E> bounded = finite & one_side;
    const E r[3] = {E(S(1)) / z[0], E(S(1)) / z[1], E(S(1)) / z[2]};
    const E margin = (E(S(2e-6)) * (far + wide) + E(S(4) * prints.slack + S(1e-18))) * max(max(abs(r[0]), abs(r[1])), abs(r[2]));
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k) {
        const E(&at)[3] = k == 0 ? x : y;
        const E a = at[0] * r[0], b = at[1] * r[1], c = at[2] * r[2];
        to.lo[k] = select(bounded, min(min(a, b), c) - margin, minus_infinity);
        to.hi[k] = select(bounded, max(max(a, b), c) + margin, infinity);
    }
}

template <FloatBatch F>
LANECAST_INLINE void TriangleImages<F>::list_pairs(const Footprints<F>& prints, VectorSet vectors, std::uint32_t count,
                                                   PairList<F>& list) const {
    const std::uint32_t all = (1u << count) - 1u;
    for_each_bit(vectors, [&](std::uint32_t vector) {
        const E lo_x(prints.lo[0][vector]), hi_x(prints.hi[0][vector]), lo_y(prints.lo[1][vector]), hi_y(prints.hi[1][vector]);
        std::uint32_t beside = 0;
        for (std::uint32_t g = 0; g < groups && g * W < count; ++g) {
            const Group& image = group[g];
            const auto largest = [&](std::uint32_t i) {
                const E(&f)[3] = image.edge[i];
                return f[2] + (max(f[0] * lo_x, f[0] * hi_x) + max(f[1] * lo_y, f[1] * hi_y));
            };
            const Mask<E> outside = (largest(0) < E(S(0))) | (largest(1) < E(S(0))) | (largest(2) < E(S(0)));
            const Mask<E> apart = (image.lo[0] > hi_x) | (image.hi[0] < lo_x) | (image.lo[1] > hi_y) | (image.hi[1] < lo_y);
            beside |= bits(outside | apart) << (g * W);
        }
        const std::uint32_t candidates = ~beside & all;
        const auto triangles = __builtin_bit_cast(EightBytes, bit_lists.of[candidates]);
        const EightPairs eight = __builtin_convertvector(triangles, EightPairs) + static_cast<std::uint16_t>(8 * vector);
        __builtin_memcpy(list.pairs + list.count, &eight, sizeof eight);
        list.count += count_bits(candidates);
    });
}

} // namespace lanecast::inline LANECAST_ISA
