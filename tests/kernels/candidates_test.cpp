// Candidates of a packet: none of the triangles that its rays hit is lost, whatever its rays have in common, and most of those
// that they miss are.

#include "kernels/kernel_support.hpp"
#include "render/kernels/candidates.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using Point = std::array<double, 3>;

/// Rays and triangles around one line of sight, z along it.
struct Sight {
    Common common;
    double distance, spread; ///< of the triangles from the apex, and of the rays there
    Point apex;
    double slope[2];
    int permutation;
    std::array<int, 3> sign;

    /// (x, y) in units of the spread at depth z (1: where the triangles are), in the scene's axes.
    [[nodiscard]] Point at(double x, double y, double z) const {
        const double fan = common == Common::point ? z : 1;
        const double depth = z * distance;
        const Point p{slope[0] * depth + x * spread * fan, slope[1] * depth + y * spread * fan, depth};
        Point q{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t axis = (k + static_cast<std::size_t>(permutation)) % 3;
            q[axis] = apex[axis] + sign[axis] * p[k];
        }
        return q;
    }
};

Sight draw_sight(Lottery& random) {
    Sight sight;
    sight.common = random.chance(0.4) ? Common::direction : Common::point;
    sight.distance = random.magnitude(1e-4, 1);
    sight.spread = sight.distance * random.magnitude(1e-6, 0.1);
    sight.permutation = random.below(3);
    for (std::size_t k = 0; k < 3; ++k) {
        sight.apex[k] = random.chance(0.1) ? 0 : static_cast<double>(static_cast<float>(random.uniform(-1, 1)));
        sight.sign[k] = random.chance(0.5) ? 1 : -1;
    }
    for (double& s : sight.slope) s = random.chance(0.1) ? 0.2 : random.uniform(0.2, 0.7);
    return sight;
}

using Triangle = std::array<Point, 3>;
Triangle draw_triangle(Lottery& random, const Sight& sight) {
    const double size = random.magnitude(1e-3, 3);
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    Triangle triangle;
    for (Point& p : triangle)
        p = sight.at(x + size * random.uniform(-1, 1), y + size * random.uniform(-1, 1), 1 + 0.3 * size * random.uniform(-1, 1));
    switch (random.below(8)) {
    case 0: // a needle
        for (std::size_t k = 0; k < 3; ++k) triangle[2][k] = triangle[0][k] + (triangle[1][k] - triangle[0][k]) * 0.7;
        break;
    case 1: // seen edge-on: c on the line of sight of a
        triangle[2] = sight.at(x, y, 1.2);
        triangle[0] = sight.at(x, y, 0.9);
        break;
    case 2: // around the apex
        for (std::size_t v = 0; v < 3; ++v)
            triangle[v] = sight.at(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 1));
        break;
    case 3: // a point
        triangle[1] = triangle[0];
        break;
    default:
        break;
    }
    return triangle;
}

struct Tally {
    std::uint64_t hit = 0, lost = 0, missed = 0, proposed = 0, packets = 0, without = 0;
};

template <FloatBatch F>
void try_packet(Lottery& random, Packet<F>& packet, bool adversarial, Tally& tally) {
    using S = Scalar<F>;
    constexpr std::uint32_t W = width<F>;
    const Sight sight = draw_sight(random);
    const bool from_end = sight.common == Common::point && random.chance(0.5);
    const auto triangles = static_cast<std::uint32_t>(1 + random.below(8));
    std::vector<Triangle> leaf;
    alignas(64) float block[9 * 8 + 16] = {};
    for (std::uint32_t t = 0; t < triangles; ++t) {
        leaf.push_back(draw_triangle(random, sight));
        for (std::uint32_t v = 0; v < 3; ++v)
            for (std::uint32_t k = 0; k < 3; ++k) {
                block[(3 * v + k) * triangles + t] = static_cast<float>(leaf[t][v][k]);
                leaf[t][v][k] = static_cast<double>(block[(3 * v + k) * triangles + t]);
            }
    }

    // vectors of rays that are close together; adversarial ones go for vertices and edges
    packet.count =
        W * static_cast<std::uint32_t>(packet_vectors<F>) - static_cast<std::uint32_t>(random.below(static_cast<int>(W)));
    std::int32_t key = -1;
    std::uint32_t rays = 0;
    double x = 0, y = 0;
    Point aim{}; // of a whole vector
    const Point along = sight.at(0, 0, 1);
    for (int trial = 0; rays < packet.count && trial < 4096; ++trial) {
        if (rays % W == 0) {
            x = random.uniform(-1, 1);
            y = random.uniform(-1, 1);
            const Triangle& near = leaf[static_cast<std::size_t>(random.below(static_cast<int>(triangles)))];
            const double f = random.chance(0.5) ? 0 : random.uniform(0, 1);
            const auto v = static_cast<std::size_t>(random.below(3));
            for (std::size_t k = 0; k < 3; ++k) aim[k] = near[v][k] + f * (near[(v + 1) % 3][k] - near[v][k]);
        }
        Point target = sight.at(x + random.uniform(-0.1, 0.1), y + random.uniform(-0.1, 0.1), 1);
        if (adversarial) {
            const double off = random.chance(0.7) ? 0 : sight.spread * random.magnitude(1e-9, 1e-3);
            for (std::size_t k = 0; k < 3; ++k) target[k] = aim[k] + off * random.uniform(-1, 1);
        }
        S org[3], dir[3];
        for (std::size_t k = 0; k < 3; ++k) {
            if (sight.common == Common::direction) {
                org[k] = static_cast<S>(target[k] - (along[k] - sight.apex[k]));
                dir[k] = static_cast<S>(along[k] - sight.apex[k]);
            } else if (from_end) {
                org[k] = static_cast<S>(sight.apex[k] + 1.5 * (target[k] - sight.apex[k]));
                dir[k] = static_cast<S>(sight.apex[k]) - org[k];
            } else {
                org[k] = static_cast<S>(sight.apex[k]);
                dir[k] = static_cast<S>(target[k] - sight.apex[k]);
            }
        }
        const std::int32_t its_key = packet_key<S>(Vec3<S>{dir[0], dir[1], dir[2]});
        if (key < 0) key = its_key;
        if (its_key != key) continue;
        for (int k = 0; k < 3; ++k) {
            packet.org[k][rays] = org[k];
            packet.dir[k][rays] = dir[k];
        }
        packet.tmin[rays] = 0;
        packet.t[rays] = from_end ? S(1) : no_limit<S>;
        packet.source[rays] = no_source;
        ++rays;
    }
    if (rays == 0) return;
    packet.count = rays;
    finish_packet(packet, key, 3.0f);
    find_footprints(packet);
    ++tally.packets;
    if (packet.prints.common == Common::nothing) { // rounded directions that do not meet
        ++tally.without;
        return;
    }
    REQUIRE((packet.prints.common == sight.common || packet.common_origin));

    const auto vectors = static_cast<std::uint32_t>(packet.vectors);
    const TriangleImages<F> images(packet, block, triangles);
    PairList<F> list;
    images.list_pairs(packet.prints, packet.all_vectors(), triangles, list);
    const std::set<std::uint32_t> pairs(list.pairs, list.pairs + list.count);
    REQUIRE(pairs.size() == list.count);
    for (std::uint32_t vector = 0; vector < vectors; ++vector)
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const std::uint32_t i = vector * W;
            const auto vertex = [&](std::uint32_t v) {
                const auto row = [&](int axis) {
                    return F(S(block[(3 * v + static_cast<std::uint32_t>(axis)) * triangles + t])) -
                           load<F>(packet.org[axis] + i);
                };
                return Vec3<F>{row(packet.axes.kx), row(packet.axes.ky), row(packet.axes.kz)};
            };
            const Vec3<F> shear{load<F>(packet.shear[0] + i), load<F>(packet.shear[1] + i), load<F>(packet.shear[2] + i)};
            const TriangleEdges<F> edges = triangle_edges(shear, vertex(0), vertex(1), vertex(2));
            const F depth = triangle_t(shear.z, edges);
            const bool hit = any(edges.inside & (depth == depth) & first_lanes<F>(rays - i));
            const bool proposed = pairs.count(8 * vector + t) != 0;
            tally.hit += hit ? 1 : 0;
            tally.missed += hit ? 0 : 1;
            tally.lost += hit && !proposed ? 1 : 0;
            tally.proposed += !hit && proposed ? 1 : 0;
        }
}

template <FloatBatch F>
Tally try_packets(int packets, bool adversarial, std::uint64_t seed) {
    Tally tally;
    if constexpr (!ScalarBatch<F>) {
        Lottery random(seed);
        const FlushDenormals flush;
        const auto packet = std::make_unique<Packet<F>>();
        for (int i = 0; i < packets; ++i) try_packet(random, *packet, adversarial, tally);
    }
    return tally;
}

} // namespace

TEST_CASE("no triangle that a ray hits is missing among the candidates") {
    const Tally tally = try_packets<NativeFloat>(cases(20000), true, 1);
    MESSAGE(tally.hit, " pairs are hit, ", tally.missed, " are not, ", tally.proposed, " of these were proposed");
    CHECK(tally.lost == 0);
    CHECK(tally.without * 10 <= tally.packets);
    CHECK((width<NativeFloat> == 1 || tally.hit > 100000u / fewer));
}

TEST_CASE("most triangles beside the rays of a vector are not candidates") {
    const Tally tally = try_packets<NativeFloat>(cases(4000), false, 2);
    MESSAGE(tally.hit, " pairs are hit, ", tally.missed, " are not, ", tally.proposed, " of these were proposed");
    CHECK(tally.lost == 0);
    CHECK(tally.proposed * 2 <= tally.missed);
}
