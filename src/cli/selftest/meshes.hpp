#pragma once
// Closed meshes whose inside is seen whole from around their centre, and scenes of them.

#include "cli/selftest/case.hpp"
#include "cli/selftest/random.hpp"
#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"
#include "scene/transform.hpp"

#include <array>
#include <vector>

namespace lanecast::selftest {

enum class Form { ball, bumpy, needles, gridded_box, staggered_ball };
inline constexpr int form_count = 4; ///< that N1 and N2 draw from

/// Of size about 1 around the origin. ball: convex, of flat quads. needles: of 1:1e4. gridded_box: flat sides. staggered_ball: no
/// two faces in one plane, so that it is convex on float's grid, too. `detail`: rows of quads.
[[nodiscard]] Mesh closed_mesh(Form form, int detail);

/// A point from which every ray meets the mesh exactly once.
[[nodiscard]] glm::dvec3 inner_point(Form form, Random& random);

/// Transformations of the class: translated up to 1e5 sizes; scaled by 1e-3 to 1e6, one in ten by 1e-15 to 1e18, which
/// normalisation takes away; stretched by up to 30 along each axis, turned and sheared; rotated, half of the time by quarter
/// turns; mirrored along one axis or three.
[[nodiscard]] std::vector<Transformation> random_placing(Placing placing, Random& random);

/// A mesh alone, but where it is translated: then a marker on the other side of the origin keeps it away from the centre.
struct MeshScene {
    SceneArrays arrays;
    Form form;
    AffineTransform world_from_object;
    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p_object) const; ///< normalised
};
[[nodiscard]] MeshScene make_mesh_scene(Form form, int detail, Placing placing, int leaf_size, Random& random);

/// A vertex of a triangle, as the kernels read it.
[[nodiscard]] glm::dvec3 corner(const SceneArrays& arrays, std::uint32_t slot, std::uint32_t k);

} // namespace lanecast::selftest
