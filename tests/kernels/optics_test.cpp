// Snell's law and Schlick's term against the same formulas in long double, for every index that a scene may have.

#include "kernels/kernel_support.hpp"
#include "render/kernels/optics.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr int W = width<F>;
constexpr double u = sizeof(S) == 4 ? 0x1p-24 : 0x1p-53;

struct Case {
    S d[3], n[3], index;
    bool inside;
};

/// Unit vectors as kernels have them: to a rounding or two, n facing d; often head on, where 1 - cos^2 is all rounding.
Case random_case(Lottery& random) {
    Case c{};
    const auto n = random.direction(), side = random.direction();
    const double tilt = random.chance(0.2) ? 0 : random.magnitude(1e-9, 1e3);
    double d[3], square = 0, along = 0;
    for (std::size_t k = 0; k < 3; ++k) d[k] = tilt * side[k] - n[k], square += d[k] * d[k], along += d[k] * n[k];
    const double sign = along > 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
        c.d[k] = static_cast<S>(d[k] / std::sqrt(square) * (1 + random.uniform(-2, 2) * u));
        c.n[k] = static_cast<S>(sign * n[k] * (1 + random.uniform(-2, 2) * u));
    }
    const double index = random.chance(0.5) ? random.uniform(0.3, 3) : random.magnitude(1e-30, 1e30);
    c.index = static_cast<S>(static_cast<float>(index));
    c.inside = random.chance(0.5);
    return c;
}

struct Result {
    double dir[3], fresnel;
    bool total;
};

Result transmit_one(const Case& c) {
    const auto t = transmit(Vec3<F>{F(c.d[0]), F(c.d[1]), F(c.d[2])}, Vec3<F>{F(c.n[0]), F(c.n[1]), F(c.n[2])}, F(c.index),
                            Mask<F>(c.inside));
    alignas(64) S lanes[4][W];
    lanecast::store(lanes[0], t.dir.x), lanecast::store(lanes[1], t.dir.y), lanecast::store(lanes[2], t.dir.z);
    lanecast::store(lanes[3], t.fresnel);
    return {{lanes[0][0], lanes[1][0], lanes[2][0]}, lanes[3][0], any(t.total)};
}

/// The sine of the refracted ray, above 1 under total internal reflection, and the part of d along the surface.
struct Truth {
    long double sin_out = 0, sin_in = 0, tangent[3] = {}, n[3] = {}, n1 = 1, n2 = 1;
};

Truth truth(const Case& c) {
    Truth t;
    (c.inside ? t.n1 : t.n2) = c.index;
    long double length_d = 0, length_n = 0, cosine = 0;
    for (int k = 0; k < 3; ++k) {
        length_d += static_cast<long double>(c.d[k]) * c.d[k];
        length_n += static_cast<long double>(c.n[k]) * c.n[k];
    }
    length_d = std::sqrt(length_d), length_n = std::sqrt(length_n);
    for (int k = 0; k < 3; ++k) t.n[k] = c.n[k] / length_n, cosine -= c.d[k] / length_d * t.n[k];
    for (int k = 0; k < 3; ++k) t.tangent[k] = c.d[k] / length_d + cosine * t.n[k], t.sin_in += t.tangent[k] * t.tangent[k];
    t.sin_in = std::sqrt(t.sin_in);
    t.sin_out = t.sin_in * t.n1 / t.n2;
    return t;
}

} // namespace

TEST_CASE("transmit: a unit direction and Schlick's term in [0, 1], whatever the index") {
    Lottery random(3);
    int wrong = 0;
    for (int n = 0; n < cases(400000); ++n) {
        const Case c = random_case(random);
        const Result r = transmit_one(c);
        const double length = std::sqrt(r.dir[0] * r.dir[0] + r.dir[1] * r.dir[1] + r.dir[2] * r.dir[2]);
        const bool sound = std::fabs(length - 1) < 32 * u && r.fresnel >= -8 * u && r.fresnel <= 1 + 8 * u;
        if (!sound && ++wrong <= 5)
            MESSAGE("index " << double(c.index) << " inside " << c.inside << " length " << length << " fresnel " << r.fresnel);
    }
    CHECK(wrong == 0);
}

TEST_CASE("transmit: Snell's law and Schlick's term, away from the critical angle") {
    Lottery random(4);
    int wrong = 0, tested = 0, total = 0;
    for (int n = 0; n < cases(400000); ++n) {
        const Case c = random_case(random);
        const Truth t = truth(c);
        const double eta = static_cast<double>(t.n1 / t.n2);
        const double error = 16 * u * std::max(1.0, eta); // of the sine: what rounds d and n is multiplied by eta
        if (error > 1e-3 || std::fabs(static_cast<double>(t.sin_out) - 1) < std::max(0.01, 4 * error)) continue;
        ++tested;
        const Result r = transmit_one(c);
        bool right = r.total == (t.sin_out > 1);
        if (t.sin_out > 1) {
            ++total;
            right = right && r.fresnel == 1;
        } else {
            const long double cos_out = std::sqrt(1 - t.sin_out * t.sin_out);
            for (int k = 0; k < 3; ++k) {
                const long double exact = t.tangent[k] * static_cast<long double>(eta) - t.n[k] * cos_out;
                right = right && std::fabs(static_cast<double>(r.dir[k] - exact)) < 16 * error;
            }
            const long double r0 = ((t.n1 - t.n2) / (t.n1 + t.n2)) * ((t.n1 - t.n2) / (t.n1 + t.n2));
            const long double cosine = t.n1 > t.n2 ? cos_out : std::sqrt(1 - t.sin_in * t.sin_in);
            const long double exact = r0 + (1 - r0) * std::pow(1 - cosine, 5.0L);
            right = right && std::fabs(static_cast<double>(r.fresnel - exact)) < 64 * error;
        }
        if (!right && ++wrong <= 5)
            MESSAGE("index " << double(c.index) << " inside " << c.inside << " sine " << double(t.sin_in));
    }
    CHECK(tested > cases(100000));
    CHECK(total > cases(1000));
    CHECK(wrong == 0);
}
