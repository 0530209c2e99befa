#pragma once
// Random numbers, bit patterns and ulp distances for tests of kernels. Header only: each test is compiled once per ISA.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lanecast::test {

#ifdef LANECAST_SANITIZED
inline constexpr int fewer = 20;
#else
inline constexpr int fewer = 1;
#endif
/// The number of random cases to run: `n` in plain builds, a twentieth in sanitized ones.
constexpr int cases(int n) { return n / fewer > 0 ? n / fewer : 1; }

/// Vigna's splitmix64: the same numbers on every ISA and library.
struct Lottery {
    std::uint64_t state;
    explicit Lottery(std::uint64_t seed) : state(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    bool chance(double p) { return uniform(0, 1) < p; }
    /// Log-uniform.
    double magnitude(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
    std::array<double, 3> direction() {
        for (;;) {
            const std::array<double, 3> p{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
            const double l = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            if (l > 0.1 && l <= 1) return {p[0] / l, p[1] / l, p[2] / l};
        }
    }
    /// Any float: all bit patterns, the awkward ones often.
    float any_float() {
        static constexpr float awkward[] = {0.0f,
                                            -0.0f,
                                            1.0f,
                                            -1.0f,
                                            std::numeric_limits<float>::infinity(),
                                            -std::numeric_limits<float>::infinity(),
                                            std::numeric_limits<float>::quiet_NaN(),
                                            -std::numeric_limits<float>::quiet_NaN(),
                                            std::numeric_limits<float>::max(),
                                            std::numeric_limits<float>::lowest(),
                                            std::numeric_limits<float>::min(),
                                            -std::numeric_limits<float>::min(),
                                            std::numeric_limits<float>::denorm_min(),
                                            -std::numeric_limits<float>::denorm_min(),
                                            0.99999994f,
                                            1.0000001f};
        switch (below(4)) {
        case 0:
            return awkward[static_cast<std::size_t>(below(std::size(awkward)))];
        case 1:
            return static_cast<float>(uniform(-4, 4));
        case 2:
            return static_cast<float>(below(9) - 4);
        default:
            return std::bit_cast<float>(static_cast<std::uint32_t>(bits()));
        }
    }
};

/// NaNs are one value: their payloads are not promised.
inline std::uint32_t canonical(float x) { return x != x ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x); }
inline std::uint64_t canonical(double x) { return x != x ? 0x7ff8000000000000u : std::bit_cast<std::uint64_t>(x); }

/// Distance of `value` from `exact` in units of the last place that a float near `exact` has.
inline double ulps(float value, double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    return std::fabs(static_cast<double>(value) - exact) / std::ldexp(1.0, exponent - 24);
}

/// FNV-1a over words.
struct Hash {
    std::uint64_t value = 0xcbf29ce484222325u;
    void add(std::uint32_t word) { value = (value ^ word) * 0x100000001b3u; }
};

} // namespace lanecast::test
