#include "lanecast/describe.hpp"

#include "scene/error.hpp"
#include "scene/load_scene.hpp"
#include "scene/mesh_file.hpp"
#include "scene/read_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace lanecast {
namespace {

constexpr float largest_position = 1e30f; ///< as in files

[[noreturn]] void refuse(std::size_t mesh, const std::string& what) {
    throw Error(ExitCode::scene, "mesh " + std::to_string(mesh) + ": " + what);
}

std::vector<glm::dvec3> copy_positions(const MeshArrays& mesh, std::size_t number) {
    std::vector<glm::dvec3> positions(mesh.vertex_count);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(mesh.positions);
    bool finite = true;
    for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
        float p[3];
        std::memcpy(p, bytes + i * mesh.stride, sizeof p);
        finite = finite && std::abs(p[0]) <= largest_position && std::abs(p[1]) <= largest_position &&
                 std::abs(p[2]) <= largest_position;
        positions[i] = {p[0], p[1], p[2]};
    }
    if (!finite) refuse(number, "coordinates must be numbers between -1e30 and 1e30");
    return positions;
}

std::vector<std::array<std::uint32_t, 3>> copy_triangles(const MeshArrays& mesh, std::size_t number) {
    std::vector<std::array<std::uint32_t, 3>> triangles(mesh.triangle_count);
    if (mesh.indices == nullptr) {
        if (mesh.triangle_count > mesh.vertex_count / 3) refuse(number, "without indices every triangle needs three vertices");
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
        return triangles;
    }
    if (!triangles.empty()) std::memcpy(triangles.data(), mesh.indices, triangles.size() * sizeof triangles[0]);
    std::uint32_t largest = 0;
    for (const auto& [a, b, c] : triangles) largest = std::max({largest, a, b, c});
    if (!triangles.empty() && largest >= mesh.vertex_count)
        refuse(number, "index " + std::to_string(largest) + " is out of range: there are " + std::to_string(mesh.vertex_count) +
                           " vertices");
    return triangles;
}

void add_mesh(SceneDescription& scene, Mesh mesh) {
    if (!mesh.positions.empty()) { // a camera far off would make the geometry's units coarser
        scene.camera.position = mesh.positions.front();
        scene.camera.look_at = scene.camera.position + glm::dvec3(0, 0, -1);
    }
    scene.objects.push_back({std::move(mesh), {}, {}, {}});
}

} // namespace

SceneDescription describe(std::span<const MeshArrays> meshes) {
    SceneDescription scene;
    std::size_t elements = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].stride % sizeof(float) != 0 || meshes[i].stride < 3 * sizeof(float))
            refuse(i, "the stride must be a multiple of 4 bytes, at least 12, got " + std::to_string(meshes[i].stride));
        elements += std::max(meshes[i].vertex_count / 3, meshes[i].triangle_count);
        if (meshes[i].vertex_count > 3 * max_mesh_elements || elements > max_mesh_elements)
            refuse(i, "the meshes up to this one have more than " + std::to_string(max_mesh_elements) + " triangles");
        Mesh mesh;
        mesh.positions = copy_positions(meshes[i], i);
        mesh.triangles = copy_triangles(meshes[i], i);
        add_mesh(scene, std::move(mesh));
    }
    return scene;
}

SceneDescription describe(const std::filesystem::path& file) {
    const MeshFormat format = mesh_format(file);
    if (format == MeshFormat::unknown) return load_scene(file).description;
    const FileBytes bytes = read_file(file);
    const std::string name = file.string();
    if (!bytes.fault.empty()) throw Error(ExitCode::asset, "cannot read " + name + ": " + bytes.fault);
    SceneDescription scene;
    MeshWarnings warnings;
    add_mesh(scene, format == MeshFormat::obj ? read_obj(bytes.view(), name, file.parent_path(), Material{}, warnings)
                                              : read_ply(bytes.view(), name));
    return scene;
}

} // namespace lanecast
