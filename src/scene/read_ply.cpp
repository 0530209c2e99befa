// The body of PLY files. Elements other than `vertex` and `face`, and properties other than x, y, z and the vertex indices, are
// skipped.

#include "scene/diagnostic.hpp"
#include "scene/error.hpp"
#include "scene/mesh_file.hpp"
#include "scene/ply_header.hpp"
#include "scene/read_number.hpp"
#include "scene/scene_format.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace lanecast {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
T load(const char* at, bool swap) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, at, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

double load(const char* at, PlyType type, bool swap) {
    switch (type) {
    case PlyType::int8:
        return static_cast<signed char>(*at);
    case PlyType::uint8:
        return static_cast<unsigned char>(*at);
    case PlyType::int16:
        return load<std::int16_t>(at, swap);
    case PlyType::uint16:
        return load<std::uint16_t>(at, swap);
    case PlyType::int32:
        return load<std::int32_t>(at, swap);
    case PlyType::uint32:
        return load<std::uint32_t>(at, swap);
    case PlyType::float32:
        return static_cast<double>(load<float>(at, swap));
    case PlyType::float64:
        return load<double>(at, swap);
    }
    return 0;
}

/// Values one after the other, whatever the format. Every number of a PLY file fits a double exactly.
class BinaryBody {
public:
    BinaryBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
        : bytes_(bytes), at_(header.body), swap_(header.format == PlyFormat::big_endian), name_(name) {}

    double next(PlyType type) {
        require(size_of(type));
        start_ = at_;
        at_ += size_of(type);
        return load(bytes_.data() + start_, type, swap_);
    }
    void skip(PlyType type, std::size_t count) {
        if (count > (bytes_.size() - at_) / size_of(type)) require(bytes_.size());
        at_ += count * size_of(type);
    }
    /// Whether `count` values of a type can follow.
    [[nodiscard]] bool has_room(PlyType type, std::size_t count) const { return count <= (bytes_.size() - at_) / size_of(type); }
    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ExitCode::asset, name_ + ": error: at byte " + std::to_string(start_) + ": " + message);
    }

private:
    void require(std::size_t size) {
        if (size <= bytes_.size() - at_) return;
        start_ = bytes_.size();
        fail("the file ends too early");
    }

    std::string_view bytes_;
    std::size_t at_, start_ = 0;
    bool swap_;
    const std::string& name_;
};

class TextBody {
public:
    TextBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
        : bytes_(bytes), at_(bytes.data() + header.body), start_(at_), end_(bytes.data() + bytes.size()), name_(name) {}

    double next(PlyType) {
        while (at_ != end_ && is_space(*at_)) ++at_;
        start_ = at_;
        double value = 0;
        if (at_ == end_) fail("the file ends too early");
        if (!read_number(at_, end_, value) || (at_ != end_ && !is_space(*at_))) {
            while (at_ != end_ && !is_space(*at_)) ++at_;
            fail("must be a number, got `" + printable({start_, static_cast<std::size_t>(at_ - start_)}, 40) + "`");
        }
        return value;
    }
    void skip(PlyType type, std::size_t count) {
        for (; count > 0; --count) next(type);
    }
    [[nodiscard]] bool has_room(PlyType, std::size_t count) const { return count <= static_cast<std::size_t>(end_ - at_); }
    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ExitCode::asset,
                    format_diagnostic(name_, bytes_, static_cast<std::size_t>(start_ - bytes_.data()), "error", message));
    }

private:
    static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

    std::string_view bytes_;
    const char *at_, *start_, *end_;
    const std::string& name_;
};

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

template <class Body>
void read_vertices(Body& body, const PlyElement& element, std::vector<glm::dvec3>& positions) {
    std::vector<int> axes; // of each property; 3: not a coordinate
    for (const PlyProperty& property : element.properties) {
        const std::size_t axis = std::string_view("xyz").find(property.name);
        axes.push_back(property.name.size() == 1 && axis < 3 && !property.is_list ? static_cast<int>(axis) : 3);
    }
    for (int axis = 0; axis < 3; ++axis)
        if (std::ranges::count(axes, axis) != 1) body.fail("a vertex must have the properties x, y and z, once each");
    positions.reserve(element.count);
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

template <class Body>
void read_faces(Body& body, const PlyElement& element, std::uint64_t vertex_count, Mesh& mesh) {
    const auto holds_indices = [](const PlyProperty& property) {
        return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    if (std::ranges::count_if(element.properties, holds_indices) != 1) body.fail("a face must have one list of `vertex_indices`");
    mesh.triangles.reserve(element.count);
    for (std::uint64_t face = 0; face < element.count; ++face) {
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
    const auto only = [&](std::string_view element_name) {
        const auto found = std::ranges::find(header.elements, element_name, &PlyElement::name);
        if (found == header.elements.end() || std::ranges::count(header.elements, element_name, &PlyElement::name) > 1)
            throw Error(ExitCode::asset, name + ": error: a PLY mesh must have one element `" + std::string(element_name) + "`");
        return found;
    };
    only("face");
    const PlyElement& vertices = *only("vertex");
    if (header.format == PlyFormat::ascii) return read_body(TextBody(bytes, header, name), header, vertices);
    return read_body(BinaryBody(bytes, header, name), header, vertices);
}

} // namespace lanecast
