#include "scene/load_parts.hpp"

#include "scene/mesh_file.hpp"
#include "scene/read_file.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <utility>

namespace lanecast {
namespace {

/// `triangles`: [[[x, y, z], [x, y, z], [x, y, z]], ...]
Mesh load_triangles(const SceneReader& reader, NodeId list) {
    const std::vector<JsonNode>& nodes = reader.document.nodes;
    const auto check_list = [&](NodeId node, const char* wanted) {
        if (nodes[node].kind != JsonKind::list || nodes[node].count != 3)
            fail(reader, node, std::string("must be ") + wanted + ", got " + shown(reader, node));
    };
    const auto coordinate = [&](NodeId node) {
        if (nodes[node].kind != JsonKind::number) fail(reader, node, "must be a number, got " + shown(reader, node));
        const double value = nodes[node].number;
        if (!(value >= -largest_magnitude && value <= largest_magnitude))
            fail(reader, node, "must be a number between -1e30 and 1e30, got " + shown(reader, node));
        return value;
    };
    Mesh out;
    out.positions.reserve(std::size_t{nodes[list].count} * 3);
    out.triangles.reserve(nodes[list].count);
    for (NodeId triangle = list + 1; triangle < nodes[list].next; triangle = nodes[triangle].next) {
        check_list(triangle, "a triangle of three points [[x, y, z], [x, y, z], [x, y, z]]");
        const auto first = static_cast<std::uint32_t>(out.positions.size());
        for (NodeId point = triangle + 1; point < nodes[triangle].next; point = nodes[point].next) {
            check_list(point, "a point [x, y, z]");
            NodeId at = point + 1;
            glm::dvec3 position;
            for (int axis = 0; axis < 3; ++axis, at = nodes[at].next) position[axis] = coordinate(at);
            out.positions.push_back(position);
        }
        out.triangles.push_back({first, first + 1, first + 2});
    }
    return out;
}

Mesh load_mesh_file(SceneReader& reader, NodeId node, const Material& material) {
    const std::string file(text_of(reader.document, node));
    if (file.empty() || file.find('\0') != std::string::npos)
        fail(reader, node, "must be the name of a mesh file, got " + shown(reader, node));
    const std::filesystem::path path = reader.directory / file;
    const std::string name = printable_path(path);
    const MeshFormat format = mesh_format(path);
    if (format == MeshFormat::unknown)
        fail(reader, node, "must end in .obj or .ply, got " + shown(reader, node), ExitCode::asset);
    const FileBytes bytes = read_file(path);
    if (!bytes.fault.empty()) fail(reader, node, "cannot read " + name + ": " + bytes.fault, ExitCode::asset);

    const auto asked_by = [&] { return "\n" + message_at(reader, node, "note", "asks for this file"); };
    MeshWarnings warnings{.strict = reader.strict};
    try {
        Mesh out = format == MeshFormat::obj ? read_obj(bytes.view(), name, path.parent_path(), material, warnings)
                                             : read_ply(bytes.view(), name);
        out.file = file;
        for (std::string& warning : warnings.messages) {
            if (reader.mesh_warnings.size() < max_remarks)
                reader.mesh_warnings.push_back(std::move(warning) + asked_by());
            else
                ++reader.remarks_dropped;
        }
        if (warnings.dropped > 0 && reader.mesh_warnings.size() < max_remarks)
            reader.mesh_warnings.push_back(name + ": warning: " + more_warnings(warnings.dropped));
        else
            reader.remarks_dropped += warnings.dropped;
        return out;
    } catch (const Error& error) { // the reader does not know which object asks
        throw Error(error.code(), error.what() + asked_by());
    }
}

Mesh load_mesh(SceneReader& reader, const Block& block, const Material& material) {
    const NodeId triangles = block.find("triangles");
    const NodeId file = block.find("file");
    if (triangles != no_node && file != no_node) fail(reader, file, "a mesh has `triangles` or a `file`, not both");
    if (triangles == no_node && file == no_node)
        fail(reader, block.node(),
             "a mesh needs `triangles` or a `file`" + block.misspelling("triangles") + block.misspelling("file"));
    if (file == no_node && !block.has("material")) fail(reader, block.node(), "lacks the key `material`");
    const NodeId source = triangles != no_node ? triangles : file;
    Mesh out = triangles != no_node ? load_triangles(reader, triangles) : load_mesh_file(reader, file, material);
    if (out.triangles.empty()) warn(reader, source, "the mesh has no triangles");
    reader.mesh_elements += std::max(out.positions.size() / 3, out.triangles.size());
    if (reader.mesh_elements > max_mesh_elements)
        fail(reader, source, "the meshes up to this one have more than " + std::to_string(max_mesh_elements) + " triangles",
             ExitCode::memory);
    return out;
}

Object load_object(SceneReader& reader, NodeId node) {
    const BlockSpec& spec = spec_by_type(reader, node, format::shapes);
    const Block block(reader, node, spec);
    Object out;
    block.read("name", out.name);
    if (block.has("material")) out.material = load_material(reader, block.find("material"));
    if (spec.name == "sphere") {
        Sphere sphere;
        block.read("radius", sphere.radius);
        block.read("position", sphere.position);
        out.shape = sphere;
    } else if (spec.name == "cylinder") {
        Cylinder cylinder;
        block.read("radius", cylinder.radius);
        block.read("height", cylinder.height);
        block.read("capped", cylinder.capped);
        out.shape = cylinder;
    } else if (spec.name == "cone") {
        Cone cone;
        block.read("base_radius", cone.base_radius);
        block.read("apex_radius", cone.apex_radius);
        block.read("height", cone.height);
        block.read("capped", cone.capped);
        out.shape = cone;
    } else if (spec.name == "plane") {
        Plane plane;
        block.read("position", plane.position);
        block.read("normal", plane.normal);
        out.shape = plane;
    } else {
        out.shape = load_mesh(reader, block, out.material);
    }
    if (block.has("transformations")) out.transformations = load_transformations(reader, block.find("transformations"));
    return out;
}

} // namespace

Material load_material(SceneReader& reader, NodeId node) {
    const Block block(reader, node, format::material);
    Material out;
    block.read("ambient", out.ambient);
    block.read("diffuse", out.diffuse);
    block.read("specular", out.specular);
    block.read("reflective", out.reflective);
    block.read("transmissive", out.transmissive);
    block.read("shininess", out.shininess);
    block.read("refraction", out.refraction);
    return out;
}

std::vector<Object> load_objects(SceneReader& reader, NodeId list) {
    std::vector<Object> out;
    for (const NodeId node : items(reader, list)) out.push_back(load_object(reader, node));
    return out;
}

} // namespace lanecast
