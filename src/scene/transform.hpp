#pragma once
// Transformations of an object, composed in double.

#include "scene/description.hpp"

#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace lanecast {

/// p_world = linear * p_object + translation.
struct AffineTransform {
    glm::dmat3 linear{1};
    glm::dvec3 translation{0};
};

/// Similarity: uniform scale times a rotation or a mirrored one, so a sphere stays a sphere.
enum class TransformClass { similarity, affine };

/// Right-handed; exact at quarter turns about the axes.
[[nodiscard]] glm::dmat3 matrix_of(const Rotation& rotation);

/// Applied to the object first to last.
[[nodiscard]] AffineTransform compose(std::span<const Transformation> transformations);

[[nodiscard]] glm::dvec3 apply(const AffineTransform& world_from_object, const glm::dvec3& p_object);

/// A similarity to within 2^-32 of its scale, which is far below half an ulp of a float.
[[nodiscard]] TransformClass classify(const glm::dmat3& linear);

/// Of a similarity: its uniform scale. Of any other: the geometric mean of its scales.
[[nodiscard]] double uniform_scale(const glm::dmat3& linear);

[[nodiscard]] bool is_mirroring(const glm::dmat3& linear);

/// Not finite where `linear` is singular.
[[nodiscard]] glm::dmat3 inverted(const glm::dmat3& linear);

/// Skeel's: the largest row sum of |inverse| |linear|. How many ulp of an object-space coordinate a rounding of the stored
/// inverse can cost; about 1 for any scale along the axes, largest scale / smallest scale once that is rotated.
[[nodiscard]] double condition(const glm::dmat3& linear, const glm::dmat3& inverse);

/// Unit vector along `v`, for lengths from 1e-300 to 1e300.
[[nodiscard]] glm::dvec3 unit(const glm::dvec3& v);

[[nodiscard]] bool is_finite(const glm::dvec3& v);
[[nodiscard]] bool is_finite(const glm::dmat3& m);

} // namespace lanecast
