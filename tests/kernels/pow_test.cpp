// pow against long double, and the same bits at every width.

#include "kernels/kernel_support.hpp"
#include "simd/pow.hpp"

#include <doctest/doctest.h>

#include <cstdio>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr int W = width<F>;
constexpr S u = sizeof(S) == 4 ? S(0x1p-24) : S(0x1p-53);

struct Case {
    S x, y;
};
Case random_case(Lottery& random) {
    switch (random.below(4)) {
    case 0: // highlights
        return {static_cast<S>(random.uniform(0, 1)), static_cast<S>(random.uniform(0, 300))};
    case 1: // their centres, where x is next to 1
        return {static_cast<S>(1 - random.magnitude(1e-7, 1)), static_cast<S>(random.magnitude(1e-3, 1e7))};
    case 2:
        return {static_cast<S>(random.magnitude(1e-37, 1)), static_cast<S>(random.magnitude(1e-6, 1e3))};
    default: // above 1 by rounding
        return {static_cast<S>(1 + random.uniform(0, 4) * static_cast<double>(u)), static_cast<S>(random.uniform(0, 1e5))};
    }
}

S pow_of(Case c) {
    alignas(64) S lanes[W];
    lanecast::store(lanes, lanecast::pow(F(c.x), F(c.y)));
    return lanes[0];
}

} // namespace

TEST_CASE("pow: within the bound of its comment") {
    Lottery random(1);
    const FlushDenormals flush;
    double worst = 0; // of the part that grows with y |ln x|, once 2 ulp are taken off
    double worst_relative = 0;
    int wrong = 0;
    for (int n = 0; n < cases(1000000); n += W) {
        alignas(64) S x[W], y[W], r[W];
        for (int i = 0; i < W; ++i) {
            const Case c = random_case(random);
            x[i] = c.x, y[i] = c.y;
        }
        lanecast::store(r, lanecast::pow(load<F>(x), load<F>(y)));
        for (int i = 0; i < W; ++i) {
            const long double exact = std::pow(static_cast<long double>(x[i]), static_cast<long double>(y[i]));
            const long double grows = static_cast<long double>(y[i]) * std::fabs(std::log(static_cast<long double>(x[i])));
            if (exact < 0x1p-125L) {
                wrong += !(r[i] >= 0 && r[i] < S(0x1p-124));
                continue;
            }
            const auto relative = static_cast<double>(std::fabs(static_cast<long double>(r[i]) - exact) / exact);
            const double in_u = relative / static_cast<double>(u);
            worst_relative = std::fmax(worst_relative, in_u / (4 + static_cast<double>(grows)));
            if (grows > 1) worst = std::fmax(worst, (in_u - 4) / static_cast<double>(grows));
            wrong += in_u > 4 + 4 * static_cast<double>(grows);
        }
    }
    MESSAGE("pow: error in u (2^-24, 2^-53) at most ", worst_relative, " (4 + y |ln x|); growing part ", worst);
    CHECK(wrong == 0);
}

TEST_CASE("pow: the corners") {
    const FlushDenormals flush;
    CHECK(pow_of({0, 0}) == 1);
    CHECK(pow_of({S(0.5), 0}) == 1);
    CHECK(pow_of({0, 1}) == 0);
    CHECK(pow_of({0, S(1e-20)}) == 0);
    CHECK(pow_of({S(1), S(1e30)}) == 1);
    CHECK(pow_of({S(0.5), S(1e30)}) == 0);
    CHECK(pow_of({S(0.5), S(1)}) == S(0.5));
    CHECK(pow_of({S(0.25), S(0.5)}) == S(0.5));
    CHECK(pow_of({S(0.5), S(126)}) == S(0x1p-126));
    // a smooth highlight has no steps: monotone in x, to within an ulp
    for (const double y : {1.0, 2.5, 20.0, 1000.0}) {
        S before = 0;
        for (int n = 1; n <= 20000; ++n) {
            const S now = pow_of({static_cast<S>(n) / S(20000), static_cast<S>(y)});
            CHECK(now >= before * (1 - 4 * u));
            before = now;
        }
    }
}

TEST_CASE("pow: the same bytes at every width") {
    if constexpr (sizeof(S) == 8) {
        return; // the reference keeps no promise towards float
    } else {
        Lottery random(2);
        const FlushDenormals flush;
        Hash hash;
        constexpr int rounds = 65536; // a multiple of every width, not reduced: the hash is of all of them
        for (int n = 0; n < rounds; n += W) {
            alignas(64) S x[W], y[W], r[W];
            for (int i = 0; i < W; ++i) {
                const Case c = random_case(random);
                x[i] = c.x, y[i] = c.y;
            }
            lanecast::store(r, lanecast::pow(load<F>(x), load<F>(y)));
            for (int i = 0; i < W; ++i) hash.add(canonical(static_cast<float>(r[i])));
        }
        CHECK(hash.value == 6735328738374469298u); // one number for all of them
    }
}
