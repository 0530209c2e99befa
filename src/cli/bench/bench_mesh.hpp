#pragma once
// Meshes to measure: files, or procedural ones of our own, with a view and lights.

#include "lanecast/lanecast.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast::bench {

struct View {
    glm::dvec3 position{0}, look_at{0, 0, -1}, up{0, 1, 0};
    double field = 45;           ///< vertical, in degrees
    glm::dvec3 light{0};         ///< a point light
    glm::dvec3 sun{0.4, 1, 0.3}; ///< towards a directional light
};

struct BenchMesh {
    std::string name;
    std::vector<float> positions; ///< x y z
    std::vector<std::uint32_t> indices;
    glm::dvec3 lo{0}, hi{0};
    View view;

    [[nodiscard]] MeshArrays arrays() const {
        return {positions.data(), positions.size() / 3, indices.data(), indices.size() / 3, 3 * sizeof(float)};
    }
    [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

inline constexpr std::size_t usual_terrain = 1048352; ///< triangles

/// `what`: flake, terrain, hall, or an OBJ or PLY file. `triangles`, about: of terrain. Throws Error.
[[nodiscard]] BenchMesh make_mesh(const std::string& what, std::size_t triangles = usual_terrain);

/// A view of the whole bounding box from outside, the mesh standing on a square of two triangles if `ground`.
void view_from_outside(BenchMesh& mesh, bool ground);
/// A view from within; `up` is an axis. The light goes to the middle of the box, at 60 % of its height.
void view_from(BenchMesh& mesh, const glm::dvec3& position, const glm::dvec3& look_at, double field,
               const glm::dvec3& up = {0, 1, 0});

// procedural.cpp
[[nodiscard]] BenchMesh make_flake();                        ///< a sphereflake, 1.03 million triangles
[[nodiscard]] BenchMesh make_terrain(std::size_t triangles); ///< a fractal, of about as many
[[nodiscard]] BenchMesh make_hall();                         ///< colonnades around a court, half a million; seen from inside

} // namespace lanecast::bench
