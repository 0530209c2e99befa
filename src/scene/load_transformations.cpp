#include "scene/load_parts.hpp"
#include "scene/transform.hpp"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace lanecast {
namespace {

bool all_within(const glm::dmat3& m) {
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(m[column][row]) <= largest_magnitude)) return false;
    return true;
}

/// The linear part and its inverse are composed side by side, since the inverse of a composed matrix loses digits.
struct Composition {
    glm::dmat3 linear{1};
    glm::dmat3 inverse{1};
    glm::dvec3 offset{0};

    void apply(const Rotation& rotation) {
        const glm::dmat3 m = matrix_of(rotation);
        linear = m * linear;
        inverse = inverse * glm::transpose(m);
        offset = m * offset;
    }
    void apply(const Scale& scale) {
        const glm::dvec3 s = scale.scale;
        linear = glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z) * linear;
        inverse = inverse * glm::dmat3(1 / s.x, 0, 0, 0, 1 / s.y, 0, 0, 0, 1 / s.z);
        offset *= s;
    }
    void apply(const Translation& translation) { offset += translation.translate; }

    [[nodiscard]] bool sound() const {
        const double reach = std::max(std::abs(offset.x), std::max(std::abs(offset.y), std::abs(offset.z)));
        return all_within(linear) && all_within(inverse) && reach <= largest_magnitude;
    }
};

Transformation load_transformation(SceneReader& reader, NodeId node) {
    const BlockSpec& spec = spec_by_type(reader, node, format::transformations);
    const Block block(reader, node, spec);
    if (spec.name == "rotation") {
        Rotation out;
        block.read("axis", out.axis);
        block.read("degrees", out.degrees);
        return out;
    }
    if (spec.name == "scale") {
        Scale out;
        block.read("scale", out.scale);
        return out;
    }
    Translation out;
    block.read("translate", out.translate);
    return out;
}

} // namespace

std::vector<Transformation> load_transformations(SceneReader& reader, NodeId list) {
    std::vector<Transformation> out;
    Composition composition;
    for (const NodeId node : items(reader, list)) {
        out.push_back(load_transformation(reader, node));
        std::visit([&](const auto& transformation) { composition.apply(transformation); }, out.back());
        if (!composition.sound())
            fail(reader, node, "the transformations up to this one make an object too large or too flat to compute with");
    }
    return out;
}

} // namespace lanecast
