#include "scene/flatten_quadrics.hpp"

#include "scene/error.hpp"
#include "scene/normalise.hpp"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

namespace lanecast {
namespace {

constexpr double smallest_size = 0x1p-60; ///< of a body; its square is still a normal float
constexpr double high_condition = 1e4;    ///< 24 bits of mantissa leave about three digits

struct Body {
    glm::dmat3 linear; ///< from the unit sphere, cylinder or cone, world units
    glm::dvec3 centre;
    double taper = 0; ///< of a cone
};

Body body_of(const FlatObject& flat) {
    const AffineTransform& t = flat.world_from_object;
    if (const auto* sphere = std::get_if<Sphere>(&flat.object->shape))
        return {t.linear * sphere->radius, apply(t, sphere->position)};
    const auto along_y = [&](double radius, double height, double taper) {
        return Body{glm::dmat3(t.linear[0] * radius, t.linear[1] * height, t.linear[2] * radius), t.translation, taper};
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&flat.object->shape)) return along_y(cylinder->radius, cylinder->height, 0);
    const auto& cone = std::get<Cone>(flat.object->shape);
    const double radius = 0.5 * (cone.base_radius + cone.apex_radius);
    const auto taper = static_cast<float>((cone.apex_radius - cone.base_radius) / radius); // as kernels know it
    return along_y(radius, cone.height, double{taper});
}

/// About its centre.
DoubleBox box_of(PrimitiveKind kind, const glm::dmat3& linear, double taper) {
    if (kind != PrimitiveKind::sphere && kind != PrimitiveKind::ellipsoid) return cone_box(linear, taper);
    const glm::dvec3 extent = ellipsoid_extent(linear);
    return {-extent, extent};
}

/// Half its edges.
glm::dvec3 extent_of(const DoubleBox& box) { return (box.hi - box.lo) * 0.5; }

void store(float* row_major, const glm::dmat3& m) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            row_major[3 * row + column] = static_cast<float>(m[column][row]) + 0.0f; // no -0
}

glm::dmat3 loaded(const float* row_major) {
    glm::dmat3 m;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) m[column][row] = double{row_major[3 * row + column]};
    return m;
}

BuildRef ref_of(const FlatObject& flat, const Box& box, std::size_t item) {
    BuildRef ref{};
    for (int axis = 0; axis < 3; ++axis) ref.lo[axis] = box.lo[axis], ref.hi[axis] = box.hi[axis];
    ref.item = static_cast<std::uint32_t>(item);
    ref.source = flat.index << source_object_shift | static_cast<std::uint32_t>(flat.kind);
    return ref;
}

[[noreturn]] void too_small(const FlatObject& flat) {
    throw Error(ExitCode::scene, label(flat) + ": is smaller than 2^-60 of the scene's geometry");
}

BuildRef add_sphere(const FlatObject& flat, const glm::dvec3& centre, const Normalisation& normalisation, Quadrics& quadrics) {
    const double radius =
        std::get<Sphere>(flat.object->shape).radius * uniform_scale(flat.world_from_object.linear) * normalisation.scale;
    if (!(radius >= smallest_size)) too_small(flat);
    SphereRecord record{};
    for (int axis = 0; axis < 3; ++axis) record.centre[axis] = static_cast<float>(centre[axis]) + 0.0f;
    record.radius = static_cast<float>(radius);
    quadrics.spheres.push_back(record);
    const glm::dvec3 stored{record.centre[0], record.centre[1], record.centre[2]};
    return ref_of(flat, quadric_box(stored, {glm::dvec3(-double{record.radius}), glm::dvec3(double{record.radius})}),
                  quadrics.spheres.size() - 1);
}

} // namespace

DoubleBox quadric_bounds(const FlatObject& object) {
    const Body body = body_of(object);
    const DoubleBox box = box_of(object.kind, body.linear, body.taper);
    return {body.centre + box.lo, body.centre + box.hi};
}

bool is_exact_quadric(const FlatObject& object, const Normalisation& normalisation) {
    return is_exact(normalisation, body_of(object).centre);
}

/// How far from the origin a body may reach in its own space: a cone of taper 2.
constexpr float largest_reach = 2.07f;

float largest_row_sum(const float (&m)[9]) {
    float largest = 0;
    for (int row = 0; row < 9; row += 3)
        largest = std::max(largest, std::abs(m[row]) + std::abs(m[row + 1]) + std::abs(m[row + 2]));
    return largest;
}

BuildRef add_quadric(const FlatObject& flat, const Normalisation& normalisation, Quadrics& quadrics) {
    const Body body = body_of(flat);
    const glm::dvec3 centre = normalised(normalisation, body.centre);
    if (flat.kind == PrimitiveKind::sphere) return add_sphere(flat, centre, normalisation, quadrics);

    const glm::dmat3 linear = body.linear * normalisation.scale;
    const glm::dvec3 extent = extent_of(box_of(flat.kind, linear, body.taper));
    if (!(std::max({extent.x, extent.y, extent.z}) >= smallest_size)) too_small(flat);
    const glm::dmat3 inverse = inverted(linear);
    const double conditioning = condition(linear, inverse);
    if (!is_finite(inverse) || !(conditioning < 0x1p40))
        throw Error(ExitCode::scene, label(flat) + ": is too flat to compute with");
    if (conditioning > high_condition) {
        char text[100];
        std::snprintf(text, sizeof text, ": is %.0e times longer than thick, askew to the axes; expect rough edges",
                      conditioning);
        quadrics.warnings.push_back(label(flat) + text);
    }
    AffineRecord record{};
    for (int axis = 0; axis < 3; ++axis) record.translation[axis] = static_cast<float>(centre[axis]) + 0.0f;
    store(record.object_from_world, inverse);
    record.taper = static_cast<float>(body.taper);
    record.stretch = largest_row_sum(record.object_from_world);
    const glm::dmat3 stored = inverted(loaded(record.object_from_world));
    if (!is_finite(stored)) throw Error(ExitCode::scene, label(flat) + ": is too flat for single precision");
    const DoubleBox stored_box = box_of(flat.kind, stored, body.taper);
    const glm::dvec3 stored_extent = extent_of(stored_box);
    if (!(std::min({stored_extent.x, stored_extent.y, stored_extent.z}) >= smallest_size)) too_small(flat);
    AffineShadingRecord shading{};
    store(shading.world_from_object, stored);
    record.radius = largest_reach * static_cast<float>(std::sqrt(glm::dot(stored[0], stored[0]) + glm::dot(stored[1], stored[1]) +
                                                                 glm::dot(stored[2], stored[2])));
    quadrics.affines.push_back(record);
    quadrics.affine_shading.push_back(shading);
    const glm::dvec3 stored_centre{record.translation[0], record.translation[1], record.translation[2]};
    return ref_of(flat, quadric_box(stored_centre, stored_box, conditioning > 4 ? conditioning : 0), quadrics.affines.size() - 1);
}

PlaneRecord plane_record(const Plane& plane, const Normalisation& normalisation) {
    const glm::dvec3 normal = unit(plane.normal);
    PlaneRecord record{};
    for (int axis = 0; axis < 3; ++axis) record.normal[axis] = static_cast<float>(normal[axis]) + 0.0f;
    record.distance = static_cast<float>(glm::dot(normal, normalised(normalisation, plane.position))) + 0.0f;
    return record;
}

} // namespace lanecast
