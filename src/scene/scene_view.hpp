#pragma once
// BOUNDARY: the flattened scene as kernels see it. Plain data, no function bodies, compiled by baseline and per-ISA code.
//
// Lengths are normalised: p = (p_world - centre) * scale, scale a power of two, so bounded geometry has coordinates of
// about 1. Primitives are numbered by *slot*: triangles first, then spheres, ellipsoids, cylinders, cones, open
// cones and planes, each kind in leaf order. Attributes that one step reads together are one record.

#include <cstdint>

namespace lanecast {

/// At most 8. A cylinder or cone is capped; open ones, cylinders too, are `open_cone`.
enum class PrimitiveKind : std::uint32_t {
    triangle = 0,
    sphere = 1,
    ellipsoid = 2,
    cylinder = 3,
    cone = 4,
    open_cone = 5,
    plane = 6
};
inline constexpr int primitive_kind_count = 7;

/// Eight children in structure-of-arrays form. Unused slots have lo = +1e30, hi = -1e30 and child 0, which no ray enters.
/// Boxes contain their primitives and were rounded outwards. 256 bytes, so four cache lines.
struct alignas(64) BvhNode {
    float lo[3][8]; ///< x, y, z
    float hi[3][8];
    std::uint64_t child[8];
};

// A child word. Inner: the node's offset in the arena in units of 64 bytes, child_is_leaf clear. Leaf: child_is_leaf,
// kind, count - 1, for triangles the block's offset in units of 64 bytes, and the first primitive as a slot.
inline constexpr std::uint64_t child_is_leaf = 1ull << 63;
inline constexpr int child_kind_shift = 60;  ///< 3 bits
inline constexpr int child_count_shift = 57; ///< 3 bits, count - 1
inline constexpr int child_block_shift = 32; ///< 25 bits, so an arena of at most 2 GiB
inline constexpr std::uint64_t child_kind_mask = 7;
inline constexpr std::uint64_t child_count_mask = 7;
inline constexpr std::uint64_t child_block_mask = 0x1ffffff;
inline constexpr int max_leaf_size = 8;

/// Kind of a leaf of triangles some of which stand in other leaves as well: instead of a slot, the word gives the place in
/// SceneView::shared_slots where the slot of each is found. Only `--bvh quality` makes such leaves.
inline constexpr std::uint32_t leaf_of_shared = 7;
inline constexpr int max_bvh_depth = 64; ///< levels of nodes; a traversal stack needs 7 * max_bvh_depth + 1 entries

// A triangle leaf block of n triangles starts on a 64-byte boundary and has 9 rows of n floats: v0.x v0.y v0.z v1.x .. v2.z.
// Reading 8 floats from any row start stays inside the arena.

struct TriangleRecord {
    float normal[3];     ///< unit, by the winding: the outside is where v0 v1 v2 turn counter-clockwise
    std::uint32_t block; ///< offset in 64-byte units << 6 | (n - 1) << 3 | lane
};

struct alignas(16) SphereRecord {
    float centre[3];
    float radius;
};

/// Ellipsoids (unit sphere), cylinders (radius 1, y in [-1/2, 1/2]) and cones (the same, radius 1 + taper * y) under an affine
/// transform.
struct alignas(64) AffineRecord {
    float translation[3];
    float object_from_world[9]; ///< row-major: p_object = object_from_world * (p - translation)
    float taper;                ///< cones: -2 to 2
    float stretch;              ///< largest sum of a row of |object_from_world|
    float radius;               ///< about the translation, of what bounds the body in the world
    float padding;
};

/// Cold: read when shading only.
struct alignas(16) AffineShadingRecord {
    float world_from_object[9]; ///< row-major: p = world_from_object * p_object + translation
    float padding[3];
};

struct PlaneRecord {
    float normal[3]; ///< unit, points outside
    float distance;  ///< normal . p
};

struct MaterialRecord {
    float ambient[3];
    float diffuse[3];
    float specular[3];
    float reflective[3];
    float transmissive[3];
    float shininess;
    float refraction; ///< 0: straight through
};

enum class LightKind : std::uint32_t { directional, point, spot };

/// Every light but the ambient one, in file order. Radiance times colours; lengths normalised.
struct LightRecord {
    LightKind kind;
    float color[3];
    float position[3];    ///< point, spot
    float direction[3];   ///< directional, spot: unit, where the light travels
    float cos_cutoff;     ///< spot: lit where dot(direction, -L) >= cos_cutoff
    float attenuation[3]; ///< point, spot: of normalised distance
    float radius;         ///< point, spot: of the source; directional: sine of half its angle
};

// What a scene contains; the renderer models only this.
inline constexpr std::uint32_t feature_triangles = 1u << 0;
inline constexpr std::uint32_t feature_spheres = 1u << 1;
inline constexpr std::uint32_t feature_ellipsoids = 1u << 2;
inline constexpr std::uint32_t feature_cylinders = 1u << 3;
inline constexpr std::uint32_t feature_cones = 1u << 4;
inline constexpr std::uint32_t feature_open_cones = 1u << 5; ///< or open cylinders
inline constexpr std::uint32_t feature_planes = 1u << 6;
inline constexpr std::uint32_t feature_lights = 1u << 7;     ///< any light but ambient
inline constexpr std::uint32_t feature_specular = 1u << 8;   ///< a material with specular not 0
inline constexpr std::uint32_t feature_reflective = 1u << 9; ///< a material with reflective not 0
inline constexpr std::uint32_t feature_transmissive = 1u << 10;
inline constexpr std::uint32_t feature_refraction = 1u << 11; ///< a transmissive material with an index that is not 0
inline constexpr std::uint32_t feature_soft_lights = 1u << 12;

struct SceneView {
    const unsigned char* arena;  ///< nodes and triangle blocks; the root node, if any, is at offset 0
    const std::uint64_t* leaves; ///< every leaf as a child word, in arena order
    const TriangleRecord* triangles;
    const SphereRecord* spheres;
    const AffineRecord* affines;               ///< ellipsoids, cylinders, cones, open cones
    const AffineShadingRecord* affine_shading; ///< as `affines`
    const PlaneRecord* planes;
    const std::uint32_t* shared_slots; ///< of the triangles in leaves of kind leaf_of_shared
    const std::uint32_t* scene_id;     ///< per slot: objects in file order, triangles in mesh order before any was dropped
    const std::uint32_t* object;       ///< per slot: index of the object in the file
    const std::uint32_t* material;     ///< per slot
    const MaterialRecord* materials;
    const LightRecord* lights;
    std::uint32_t first_slot[primitive_kind_count + 1]; ///< by PrimitiveKind; the last is the number of slots
    std::uint32_t leaf_count;                           ///< 0: no bounded primitive, no node
    std::uint32_t light_count;
    std::uint32_t features; ///< feature_* bits
    float ambient[3];       ///< sum of the ambient lights
    float background[3];
    float max_coordinate; ///< largest |coordinate| of the root's boxes
};

} // namespace lanecast
