#pragma once
// Random scenes in memory, and the checks every flattened scene must pass.

#include "scene/flatten.hpp"

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast::test {

struct Random {
    std::mt19937_64 engine;
    explicit Random(std::uint64_t seed) : engine(seed) {}
    double uniform(double lo, double hi) { return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53); }
    int below(int n) { return static_cast<int>(engine() % static_cast<std::uint64_t>(n)); }
    bool chance(double p) { return uniform(0, 1) < p; }
    glm::dvec3 point(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
    glm::dvec3 direction();
};

/// One to three transformations; `similarity`: none that stretches one axis.
[[nodiscard]] std::vector<Transformation> random_transformations(Random& random, bool similarity);

/// Spheres, ellipsoids, cylinders, planes and meshes of up to `size` primitives in a random layout: spread, coincident,
/// collinear, on a grid.
[[nodiscard]] SceneDescription random_scene(Random& random, int size);

/// Not inlined: g++ 12 warns of uninitialised strings where a variant's alternative is replaced in sight.
[[nodiscard]] Object make_object(const Shape& shape, std::vector<Transformation> transformations = {});

/// Corners are not shared.
[[nodiscard]] Mesh triangle_mesh(std::vector<std::array<glm::dvec3, 3>> triangles);

/// Long thin triangles that cross each other: spatial splits pay.
[[nodiscard]] Mesh needles(Random& random, int count);

/// Empty, or what is wrong with the tree and the arrays: each primitive in exactly one leaf, inside all boxes above it (a
/// triangle that was split: in several, each of its points inside the boxes above one of them), blocks and records consistent,
/// slots in leaf order, unused children inert, depth as promised.
[[nodiscard]] std::string check_tree(const SceneArrays& arrays);

/// Empty, or the first array that differs in its bits.
[[nodiscard]] std::string difference(const SceneArrays& a, const SceneArrays& b);

} // namespace lanecast::test
