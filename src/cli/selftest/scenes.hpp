#pragma once
// Random scenes of one kind of primitive with a few of others, and rays of every coherence at them.

#include "cli/selftest/case.hpp"
#include "cli/selftest/random.hpp"
#include "cli/selftest/rays.hpp"
#include "scene/description.hpp"

namespace lanecast::selftest {

/// An object of that kind, of size about 1; placed as asked, then moved.
[[nodiscard]] Object random_object(PrimitiveKind kind, Placing placing, const glm::dvec3& position, Random& random);

/// `count` objects, two in three of the kind; spread, on a line, on a lattice, or all in one place. Meshes have 1 to 16
/// triangles.
[[nodiscard]] SceneDescription random_scene(PrimitiveKind kind, Placing placing, int count, Random& random);

/// Shadow rays: all end at one point, which may lie on a surface, or within up to 1e-3 of it, and pass points of others or start
/// there.
[[nodiscard]] Rays rays_to_lamp(const SceneArrays& scene, std::uint64_t count, Random& random);

/// Rays of one of: a camera, a sun, everything, along the axes from lattice points, from up to `farthest` away, from one point at
/// vertices and rims, from one surface to the next, diagonal, to a lamp. A third has ranges.
[[nodiscard]] Rays random_rays(const SceneArrays& scene, std::uint64_t count, double farthest, Random& random);

/// A point on a primitive of the scene, often a vertex, an edge or a rim; anywhere if it has none that is bounded.
[[nodiscard]] glm::dvec3 random_target(const SceneArrays& scene, Random& random);

/// Every length times 2^k: geometry, transformations, camera, lights, attenuation.
[[nodiscard]] SceneDescription scaled_scene(SceneDescription scene, int k);

/// A scene of `random_scene` with materials of all kinds, one to four lights and a camera.
[[nodiscard]] SceneDescription random_lit_scene(PrimitiveKind kind, Placing placing, int count, Random& random);

} // namespace lanecast::selftest
