// The body of PLY files. Elements other than `vertex` and `face`, and properties other than x, y, z and the vertex indices, are
// skipped.

#include "scene/huge_pages.hpp"
#include "scene/mesh_file.hpp"
#include "scene/ply_body.hpp"
#include "scene/scene_format.hpp"

#include <cmath>

namespace lanecast {
namespace {

template <class Body>
std::size_t next_list_length(Body& body, const PlyProperty& list) {
    const double length = body.next(list.count_type);
    if (!(length >= 0) || length != std::floor(length))
        body.fail("the length of a list must be a whole number, got " + number_text(length));
    // Compared as doubles first: a length may exceed what an integer holds.
    if (length > 4294967295.0 || !body.has_room(list.type, static_cast<std::size_t>(length)))
        body.fail("the file is too short for a list of " + number_text(length));
    return static_cast<std::size_t>(length);
}

template <class Body>
void skip_property(Body& body, const PlyProperty& property) {
    body.skip(property.type, property.is_list ? next_list_length(body, property) : 1);
}

/// Of each property: 0 to 2 for x, y and z; 3 for what is no coordinate.
std::vector<int> axes_of(const PlyElement& element) {
    std::vector<int> axes;
    for (const PlyProperty& property : element.properties) {
        const std::size_t axis = std::string_view("xyz").find(property.name);
        axes.push_back(property.name.size() == 1 && axis < 3 && !property.is_list ? static_cast<int>(axis) : 3);
    }
    return axes;
}

bool holds_indices(const PlyProperty& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <class Body>
void read_vertices(Body& body, const PlyElement& element, std::vector<glm::dvec3>& positions) {
    const std::vector<int> axes = axes_of(element);
    positions.reserve(element.count);
    prefer_huge_pages(positions.data(), positions.capacity() * sizeof(glm::dvec3));
    for (std::uint64_t i = 0; i < element.count; ++i) {
        glm::dvec3 position;
        for (std::size_t p = 0; p < axes.size(); ++p) {
            if (axes[p] == 3) {
                skip_property(body, element.properties[p]);
                continue;
            }
            const double value = body.next(element.properties[p].type);
            if (!(std::abs(value) <= largest_magnitude))
                body.fail("vertex " + std::to_string(i) + ": a coordinate must be a number between -1e30 and 1e30, got " +
                          number_text(value));
            position[axes[p]] = value;
        }
        positions.push_back(position);
    }
}

template <class Body>
void read_polygon(Body& body, const PlyProperty& list, std::uint64_t face, std::uint64_t vertex_count, Mesh& mesh) {
    const auto index = [&] {
        const double value = body.next(list.type);
        if (!(value >= 0 && value < static_cast<double>(vertex_count)) || value != std::floor(value))
            body.fail("face " + std::to_string(face) + ": vertex " + number_text(value) + " does not exist, the file has " +
                      std::to_string(vertex_count));
        return static_cast<std::uint32_t>(value);
    };
    const std::size_t length = next_list_length(body, list);
    if (length < 3)
        body.fail("face " + std::to_string(face) + ": a face needs at least three vertices, got " + std::to_string(length));
    const std::uint32_t first = index();
    std::uint32_t before = index();
    for (std::size_t i = 2; i < length; ++i) {
        const std::uint32_t here = index();
        mesh.triangles.push_back({first, before, here});
        before = here;
    }
    if (mesh.triangles.size() > max_mesh_elements) body.fail("more than " + std::to_string(max_mesh_elements) + " triangles");
}

/// The common case at speed: triangles as one byte 3 and three 4-byte indices. Stops before the first face that is anything else,
/// and returns how many it read.
std::uint64_t read_plain_triangles(BinaryBody& body, const PlyElement& element, std::uint64_t vertex_count, Mesh& mesh) {
    const PlyProperty& list = element.properties[0];
    const bool plain = element.properties.size() == 1 && !body.swapped() && size_of(list.count_type) == 1 &&
                       (list.type == PlyType::int32 || list.type == PlyType::uint32);
    if (!plain) return 0;
    std::uint64_t face = 0;
    for (; face < element.count; ++face) {
        const char* const at = body.bytes(13);
        if (at == nullptr || *at != 3) return face;
        std::array<std::uint32_t, 3> triangle;
        std::memcpy(triangle.data(), at + 1, 12);
        if (std::max({triangle[0], triangle[1], triangle[2]}) >= vertex_count) return face; // negative ones are large, too
        mesh.triangles.push_back(triangle);
        body.advance(13);
    }
    return face;
}
std::uint64_t read_plain_triangles(TextBody&, const PlyElement&, std::uint64_t, Mesh&) { return 0; }

template <class Body>
void read_faces(Body& body, const PlyElement& element, std::uint64_t vertex_count, Mesh& mesh) {
    mesh.triangles.reserve(element.count);
    prefer_huge_pages(mesh.triangles.data(), mesh.triangles.capacity() * sizeof(mesh.triangles[0]));
    for (std::uint64_t face = read_plain_triangles(body, element, vertex_count, mesh); face < element.count; ++face) {
        for (const PlyProperty& property : element.properties) {
            if (holds_indices(property))
                read_polygon(body, property, face, vertex_count, mesh);
            else
                skip_property(body, property);
        }
    }
}

template <class Body>
Mesh read_body(Body body, const PlyHeader& header, const PlyElement& vertices) {
    Mesh out;
    for (const PlyElement& element : header.elements) {
        if (&element == &vertices)
            read_vertices(body, element, out.positions);
        else if (element.name == "face")
            read_faces(body, element, vertices.count, out);
        else
            for (std::uint64_t i = 0; i < element.count; ++i)
                for (const PlyProperty& property : element.properties) skip_property(body, property);
    }
    return out;
}

} // namespace

Mesh read_ply(std::string_view bytes, const std::string& name) {
    const PlyHeader header = read_ply_header(bytes, name);
    const auto fail = [&](std::size_t offset, const std::string& message) {
        throw Error(ExitCode::asset, format_diagnostic(name, bytes, offset, "error", message));
    };
    for (const std::string_view wanted : {"vertex", "face"})
        if (std::ranges::count(header.elements, wanted, &PlyElement::name) != 1)
            fail(0, "a PLY mesh must have one element `" + std::string(wanted) + "`");
    const PlyElement& vertices = *std::ranges::find(header.elements, "vertex", &PlyElement::name);
    const PlyElement& faces = *std::ranges::find(header.elements, "face", &PlyElement::name);
    const std::vector<int> axes = axes_of(vertices);
    for (int axis = 0; axis < 3; ++axis)
        if (std::ranges::count(axes, axis) != 1) fail(vertices.offset, "a vertex must have the properties x, y and z, once each");
    if (std::ranges::count_if(faces.properties, holds_indices) != 1)
        fail(faces.offset, "a face must have one list `vertex_indices`");

    if (header.format == PlyFormat::ascii) return read_body(TextBody(bytes, header, name), header, vertices);
    return read_body(BinaryBody(bytes, header, name), header, vertices);
}

} // namespace lanecast
