#pragma once
// Spheres, ellipsoids, cylinders, cones and planes as records.

#include "scene/bvh_refs.hpp"
#include "scene/flatten_objects.hpp"
#include "scene/scene_arrays.hpp"

#include <string>
#include <vector>

namespace lanecast {

/// Bounds in world units, without margin.
[[nodiscard]] DoubleBox quadric_bounds(const FlatObject& object);

/// Whether centring moves the object's place without rounding.
[[nodiscard]] bool is_exact_quadric(const FlatObject& object, const Normalisation& normalisation);

/// In file order; BuildRef::item is the index here.
struct Quadrics {
    std::vector<SphereRecord> spheres;
    std::vector<AffineRecord> affines; ///< ellipsoids, cylinders and cones
    std::vector<AffineShadingRecord> affine_shading;
    std::vector<std::string> warnings;
};

/// Adds the object's record and returns its box. world_from_object is the inverse of the *rounded* object_from_world, and the box
/// is that body's, so that what is shaded and bounded is what rays meet. Throws Error (scene) for a body below 2^-60 of the scene
/// or a singular transform.
[[nodiscard]] BuildRef add_quadric(const FlatObject& object, const Normalisation& normalisation, Quadrics& quadrics);

[[nodiscard]] PlaneRecord plane_record(const Plane& plane, const Normalisation& normalisation);

} // namespace lanecast
