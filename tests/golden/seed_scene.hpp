#pragma once
// The scene as the seed tracer traces it: bodies with a matrix each, and a median-split tree over those that have bounds.

#include "scene/description.hpp"

#include "golden/seed_faults.hpp"

#include <array>
#include <limits>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace lanecast::test {

template <class Real>
using Vec = glm::vec<3, Real>;
template <class Real>
using Matrix = glm::mat<4, 4, Real>;

enum class BodyKind { sphere, cylinder, plane, triangle };

template <class Real>
struct Body {
    BodyKind kind = BodyKind::sphere;
    const Material* material = nullptr;
    Matrix<Real> world_from_object{1}, object_from_world{1};
    Real radius = 0, height = 0;         ///< of spheres and cylinders, in object space
    std::array<Vec<Real>, 3> vertices{}; ///< of triangles, in object space
    Vec<Real> position{0};               ///< of planes
    Vec<Real> normal{0};                 ///< of planes and, in object space, triangles; unit unless plane_normal_length
};

template <class Real>
struct SeedBox {
    Vec<Real> lo{std::numeric_limits<Real>::infinity()};
    Vec<Real> hi{-std::numeric_limits<Real>::infinity()};
};

/// Children are numbers of nodes, or none and one body.
template <class Real>
struct SeedNode {
    SeedBox<Real> box;
    int left = -1, right = -1;
    int body = -1;
};

template <class Real>
struct SeedScene {
    std::vector<Body<Real>> bodies;
    std::vector<int> planes;           ///< numbers of bodies
    std::vector<SeedNode<Real>> nodes; ///< root at 0; empty without bounded bodies
};

/// Of a description that outlives it. Instantiated for float and double.
template <class Real>
[[nodiscard]] SeedScene<Real> make_seed_scene(const SceneDescription& description, const SeedFaults& faults);

} // namespace lanecast::test
