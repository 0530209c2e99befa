#pragma once
// BOUNDARY: what baseline code may ask of the per-ISA code. Plain data, no function bodies.

#include "scene/precision.hpp"
#include "scene/scene_view.hpp"

#include <cstdint>

namespace lanecast {

/// Camera rays: dir = forward + sx * right + sy * up, with sx = (x - width / 2) * pixel and sy = (height / 2 - y) * pixel for
/// the image point (x, y) in pixels, y down, pixel centres at .5. |forward| = 1, so t is the depth along the view axis.
struct CameraRecord {
    float org[3];
    float forward[3], right[3], up[3];
    float half_width, half_height; ///< of the image, in pixels
    float pixel;                   ///< edge of a pixel at distance 1
    float near;                    ///< t of the clip plane
};

/// Three planes of width * height floats; pixel (x, y) of the image is at (x - x0) + (y - y0) * width.
struct FilmView {
    float* rgb[3];
    std::int32_t x0, y0, width, height;
};

/// A rectangle of pixels of the image, x1 and y1 exclusive.
struct Tile {
    std::int32_t x0, y0, x1, y1;
};

enum class RayKind : std::uint32_t { primary = 0, offset = 1, shadow = 2, reflection = 3, refraction = 4 };
inline constexpr int ray_kind_count = 5;

struct RayKindStats {
    std::uint64_t rays;
    std::uint64_t batches;
    std::uint64_t first_lanes, first_active; ///< lanes, and active ones, of the packets at their first box or primitive test
    std::uint64_t last_lanes, last_active;   ///< at the last one
    std::uint64_t ticks;                     ///< time-stamp counter ticks spent tracing
};

struct TileStats {
    RayKindStats kinds[ray_kind_count];
    std::uint64_t total_ticks; ///< of the tile; less the sum over kinds: camera rays, shading, queues, film
};

// One ray of a pixel's tree, for `pick`. Lengths are normalised.
struct TraceRecord {
    std::int32_t parent; ///< index of the record that spawned it, -1: a camera ray
    std::int32_t level;
    RayKind kind;
    std::int32_t slot; ///< -1: left the scene
    float org[3], dir[3];
    float t; ///< in units of |dir|
    float point[3];
    float normal[3];     ///< unit, faces the ray
    std::int32_t inside; ///< 1: the ray hit the surface from its inside
    float fresnel;       ///< factor of the reflection; 0 where nothing is reflected
    float ambient[3];    ///< term of the local light; the background of a ray that left
    float color[3];      ///< of the ray, children included
};

struct TraceLight {
    std::int32_t ray;   ///< index of the TraceRecord
    std::int32_t light; ///< index into SceneView::lights
    float visibility[3];
    float color[3]; ///< the light's share of the local colour
};

/// Where a traced pixel is written; counts go on past the capacities, and what does not fit is left out.
struct TraceLog {
    TraceRecord* rays;
    TraceLight* lights;
    std::int32_t ray_capacity, light_capacity;
    std::int32_t ray_count, light_count;
};

enum class AntiAliasKind : std::uint32_t { off, cross, grid, edge };

struct RenderJob {
    SceneView scene;
    CameraRecord camera;
    FilmView film;
    std::int32_t image_width, image_height;
    std::int32_t tile_size;             ///< no tile is wider or higher
    const std::int32_t* pixel_order[2]; ///< x and y of the pixels of a square in Morton order: tile_size a side, edge: 4 more
    std::uint32_t pixel_order_count;
    std::int32_t depth;
    float cutoff;
    std::uint32_t shadows;              ///< 0, 1
    std::uint32_t transmissive_shadows; ///< 0, 1
    std::uint32_t schlick;
    std::uint32_t brute_force; ///< every primitive instead of the tree
    std::int32_t soft_samples; ///< per light with an extent; 0: hard
    AntiAliasKind anti_alias;
    std::int32_t samples; ///< per side
    float offset;
    std::uint32_t offset_planes;
    TraceLog* log;    ///< null but for `pick`
    const bool* stop; ///< once true, set by another thread, the rest of the tile is not traced; may be null
};

/// The caller's coordinates: (p - centre) * scale is normalised. t has the same value in both once multiplied by scale, a power
/// of two, because directions are left as they are.
struct StreamUnits {
    double centre[3];
    double scale;
};

/// How the caller numbers the primitives of an object.
struct StreamObject {
    std::uint32_t first_scene_id; ///< its primitive k has the scene id first_scene_id + k
    std::uint32_t mirrored;       ///< 1: flattening exchanged the second and third vertex of its triangles
};

/// Leaves that lately hid a light from many rays, tried first by the packets that follow: any hit will do, so answers are the
/// same.
inline constexpr std::uint32_t occluder_capacity = 4;
struct Occluders {
    std::uint32_t count;
    std::uint64_t leaf[occluder_capacity]; ///< child words; the latest first
};

/// Rays in structure-of-arrays form, each pointer to `count` elements of any alignment. t may be tmax itself; otherwise what is
/// written overlaps nothing that is read.
struct RayStream {
    const float* org[3];       ///< common_origin: one element each
    const float* dir[3];       ///< any length between 1e-18 and 1e18; t is in units of it
    const float* tmin;         ///< a hit has t > tmin; below 0 counts as 0; may be null: 0
    const float* tmax;         ///< and t <= tmax; may be null: infinity
    float* t;                  ///< out; closest_hit: of the hit, tmax where there is none. any_hit: unused. May be null
    std::int32_t* slot;        ///< out: the primitive's slot, -1 for a miss; any_hit: some primitive's. May be null
    std::uint32_t brute_force; ///< 1: every primitive instead of the tree
    std::uint32_t count;
    std::uint32_t common_origin; ///< 1: every org is the same point
    std::uint32_t coherent;      ///< 1: neighbours in the stream go nearly the same way

    const StreamUnits* units; ///< of org, tmin, tmax and t; null: normalised
    std::uint8_t* occluded;   ///< out, any_hit: 1 for a hit, 0 for a miss; may be null
    Occluders* occluders;     ///< in and out, any_hit: of this scene, from the streams before; may be null

    // Out, closest_hit: each may be null.
    const StreamObject* objects; ///< by object; null: there is only one, not mirrored
    std::uint32_t* object;       ///< no_object for a miss
    std::uint32_t* primitive;    ///< in the object, as the caller numbered them; no_object for a miss
    float* normal[3];            ///< unit, points outside; all or none; 0 for a miss
    float* u;                    ///< triangles: weights of the second and third vertex as the caller numbered them, else 0;
    float* v;                    ///< both or none
};
inline constexpr std::uint32_t no_object = 0xffffffffu;

/// The doors of one instruction set and precision.
struct KernelTable {
    const char* isa;    ///< "scalar", "sse4.2", "avx2", "avx512"
    std::int32_t width; ///< rays per vector
    Precision precision;
    std::uint64_t (*scratch_bytes)(const RenderJob&) noexcept; ///< what render_tile needs, 64-byte aligned; touched as used
    TileStats (*render_tile)(const RenderJob&, Tile, void* scratch) noexcept;
    void (*closest_hit)(const SceneView&, const RayStream&) noexcept;
    void (*any_hit)(const SceneView&, const RayStream&) noexcept;
};

} // namespace lanecast
