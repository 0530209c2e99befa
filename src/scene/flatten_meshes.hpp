#pragma once
// Meshes baked to world space: vertices rounded once, triangles as references for the tree, then as blocks and records.

#include "scene/bvh_refs.hpp"
#include "scene/flatten_objects.hpp"
#include "scene/scene_arrays.hpp"
#include "scene/scratch.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace lanecast {

/// For each object of the file the bounds of the vertices that its triangles use, in world units; empty where it is no mesh.
[[nodiscard]] std::vector<DoubleBox> mesh_bounds(const FlatObjects& objects, int threads);

/// Normalised float vertices of all meshes, at FlatObject::first_vertex.
struct BakedVertices {
    Scratch<std::array<float, 4>> positions; ///< the fourth is 0
    bool exact = true;                       ///< no coordinate was rounded by the centring
};

[[nodiscard]] BakedVertices bake_vertices(const FlatObjects& objects, const Normalisation& normalisation, int threads);

/// Writes the references of all triangles, at FlatObject::first_ref, and returns where those of degenerate ones stand, in order.
[[nodiscard]] std::vector<std::uint32_t> add_triangles(const FlatObjects& objects, const BakedVertices& vertices, BuildRef* refs,
                                                       int threads);

/// Corners in their order in the file.
[[nodiscard]] std::array<const float*, 3> corners_of(const FlatObjects& objects, const BakedVertices& vertices,
                                                     const BuildRef& ref);

/// Writes the block of n triangles at arena + 64 * block_offset, 64 * block_units(n) bytes, and the records that are not null.
/// Mirroring transforms flip the winding.
void write_triangle_leaf(const FlatObjects& objects, const BakedVertices& vertices, const BuildRef* refs, std::uint32_t n,
                         std::uint32_t block_offset, unsigned char* arena, TriangleRecord* const* records);

} // namespace lanecast
