#pragma once
// Words for what a scene holds.

#include "scene/description.hpp"
#include "scene/scene_view.hpp"

#include <iterator>

namespace lanecast {

inline constexpr const char* shape_names[] = {"sphere", "cylinder", "cone", "plane", "mesh"};
inline constexpr const char* light_names[] = {"ambient", "directional", "point", "spot"};
inline constexpr const char* primitive_names[] = {"triangle", "sphere", "ellipsoid", "cylinder", "cone", "open cone", "plane"};
static_assert(std::size(shape_names) == std::variant_size_v<Shape>);
static_assert(std::size(light_names) == std::variant_size_v<Light>);
static_assert(std::size(primitive_names) == primitive_kind_count);

[[nodiscard]] inline const char* type_name(const Shape& shape) { return shape_names[shape.index()]; }
[[nodiscard]] inline const char* type_name(const Light& light) { return light_names[light.index()]; }

} // namespace lanecast
