#pragma once
// Numbers that depend on a seed alone: Vigna's splitmix64. A block of rays gets its seed from the case and its own number, so
// what is found does not depend on threads, nor on where a run was broken off.

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lanecast::selftest {

[[nodiscard]] inline std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct Random {
    std::uint64_t state;
    explicit Random(std::uint64_t seed) : state(seed) {}

    std::uint64_t bits() { return mix(state += 0x9e3779b97f4a7c15u); }
    double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    bool chance(double p) { return uniform(0, 1) < p; }
    /// Log-uniform.
    double magnitude(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
    glm::dvec3 point(double size) {
        const double x = uniform(-size, size), y = uniform(-size, size);
        return {x, y, uniform(-size, size)};
    }
    /// Unit.
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 p = point(1);
            if (const double length = glm::length(p); length > 0.1 && length <= 1) return p / length;
        }
    }
};

} // namespace lanecast::selftest
