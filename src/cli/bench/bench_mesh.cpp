#include "cli/bench/bench_mesh.hpp"

#include "lanecast/describe.hpp"
#include "scene/error.hpp"
#include "scene/mesh_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <glm/geometric.hpp>

namespace lanecast::bench {
namespace {

void measure_bounds(BenchMesh& mesh) {
    mesh.lo = glm::dvec3(std::numeric_limits<double>::infinity());
    mesh.hi = -mesh.lo;
    for (const std::uint32_t i : mesh.indices) {
        const float* const p = &mesh.positions[std::size_t{3} * i];
        mesh.lo = glm::min(mesh.lo, glm::dvec3(p[0], p[1], p[2]));
        mesh.hi = glm::max(mesh.hi, glm::dvec3(p[0], p[1], p[2]));
    }
}

BenchMesh read_mesh(const std::string& file) {
    if (mesh_format(file) == MeshFormat::unknown)
        throw Error(ExitCode::usage, "bench: '" + file + "' is no mesh; expected flake, terrain, hall, an .obj or a .ply");
    const SceneDescription scene = describe(std::filesystem::path(file));
    const auto* const source = std::get_if<Mesh>(&scene.objects.at(0).shape);
    BenchMesh mesh;
    mesh.name = std::filesystem::path(file).stem().string();
    mesh.positions.reserve(source->positions.size() * 3);
    for (const glm::dvec3& p : source->positions)
        for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(static_cast<float>(p[axis]));
    mesh.indices.reserve(source->triangles.size() * 3);
    for (const auto& triangle : source->triangles) mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
    if (mesh.indices.empty()) throw Error(ExitCode::asset, file + ": error: there are no triangles to measure");
    return mesh;
}

} // namespace

BenchMesh make_mesh(const std::string& what, std::size_t triangles) {
    BenchMesh mesh;
    if (what == "flake")
        mesh = make_flake();
    else if (what == "terrain")
        mesh = make_terrain(triangles);
    else if (what == "hall")
        mesh = make_hall();
    else
        mesh = read_mesh(what);
    measure_bounds(mesh);
    if (what == "hall") view_from(mesh, {2.5, 2.2, 8.2}, {54, 3.6, 10.5}, 60);
    return mesh;
}

void view_from_outside(BenchMesh& mesh, bool ground) {
    const glm::dvec3 centre = 0.5 * (mesh.lo + mesh.hi), half = 0.5 * (mesh.hi - mesh.lo);
    const double radius = glm::length(half);
    View& view = mesh.view;
    view.look_at = centre;
    view.position = centre + glm::normalize(glm::dvec3(0.45, 0.4, 1)) * (radius * 2.1);
    view.light = centre + glm::dvec3(1.1, 1.9, 0.9) * radius;
    if (!ground) return;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    const double far = 8 * radius;
    for (const auto& [x, z] : {std::array{-far, -far}, std::array{far, -far}, std::array{far, far}, std::array{-far, far}})
        for (const double coordinate : {centre.x + x, mesh.lo.y, centre.z + z})
            mesh.positions.push_back(static_cast<float>(coordinate));
    for (const std::uint32_t corner : {0u, 2u, 1u, 0u, 3u, 2u}) mesh.indices.push_back(first + corner);
}

void view_from(BenchMesh& mesh, const glm::dvec3& position, const glm::dvec3& look_at, double field, const glm::dvec3& up) {
    mesh.view.position = position;
    mesh.view.look_at = look_at;
    mesh.view.field = field;
    mesh.view.up = up;
    mesh.view.light = 0.5 * (mesh.lo + mesh.hi) + up * (0.1 * glm::dot(up, mesh.hi - mesh.lo));
    mesh.view.sun = up + glm::dvec3(0.4, 0, 0) + 0.3 * glm::cross(glm::dvec3(1, 0, 0), up);
}

} // namespace lanecast::bench
