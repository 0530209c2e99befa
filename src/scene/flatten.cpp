#include "scene/flatten.hpp"

#include "scene/build_bvh.hpp"
#include "scene/flatten_lights.hpp"
#include "scene/flatten_materials.hpp"
#include "scene/flatten_meshes.hpp"
#include "scene/flatten_objects.hpp"
#include "scene/flatten_quadrics.hpp"
#include "scene/flatten_warnings.hpp"
#include "scene/normalise.hpp"
#include "scene/parallel.hpp"
#include "scene/scratch.hpp"

#include <algorithm>
#include <chrono>

namespace lanecast {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr int index_of(PrimitiveKind kind) { return static_cast<int>(kind); }

constexpr double spatial_budget = 0.3; ///< references that spatial splits may add, per primitive

/// Bounded primitives in file order, degenerate triangles taken out.
struct Bounded {
    BakedVertices vertices;
    Quadrics quadrics;
    Scratch<BuildRef> refs; ///< with room for `capacity`
    std::size_t capacity = 0;
    std::size_t count = 0;
};

/// Of each object, in world units; empty for planes.
std::vector<DoubleBox> bounds_of(const FlatObjects& objects, int threads) {
    std::vector<DoubleBox> boxes = mesh_bounds(objects, threads);
    for (const FlatObject& flat : objects.objects)
        if (flat.kind != PrimitiveKind::triangle && flat.kind != PrimitiveKind::plane) boxes[flat.index] = quadric_bounds(flat);
    return boxes;
}

/// Moves what lies between the places `gaps` together, in its order; returns how many are left.
std::size_t close_gaps(BuildRef* refs, std::size_t count, const std::vector<std::uint32_t>& gaps) {
    BuildRef* end = refs + (gaps.empty() ? count : gaps[0]);
    for (std::size_t i = 0; i < gaps.size(); ++i)
        end = std::copy(refs + gaps[i] + 1, refs + (i + 1 < gaps.size() ? gaps[i + 1] : count), end);
    return static_cast<std::size_t>(end - refs);
}

Bounded bake(const FlatObjects& objects, bool spatial, SceneArrays& arrays, int threads) {
    Bounded bounded;
    bounded.capacity =
        spatial ? objects.refs + static_cast<std::size_t>(static_cast<double>(objects.refs) * spatial_budget) : objects.refs;
    bounded.vertices = bake_vertices(objects, arrays.normalisation, threads);
    bounded.refs = make_scratch<BuildRef>(bounded.capacity);
    const std::vector<std::uint32_t> dropped = add_triangles(objects, bounded.vertices, bounded.refs.get(), threads);
    arrays.degenerate_triangles = static_cast<std::uint32_t>(dropped.size());
    arrays.normalisation.exact = bounded.vertices.exact;
    for (const FlatObject& flat : objects.objects) {
        if (flat.kind == PrimitiveKind::triangle || flat.kind == PrimitiveKind::plane) continue;
        bounded.refs[flat.first_ref] = add_quadric(flat, arrays.normalisation, bounded.quadrics);
        arrays.normalisation.exact = arrays.normalisation.exact && is_exact_quadric(flat, arrays.normalisation);
    }
    if (!dropped.empty()) arrays.warnings.push_back(dropped_triangles_warning(objects, dropped));
    bounded.count = close_gaps(bounded.refs.get(), objects.refs, dropped);
    arrays.warnings.insert(arrays.warnings.end(), bounded.quadrics.warnings.begin(), bounded.quadrics.warnings.end());
    return bounded;
}

void number_slots(const Bounded& bounded, const FlatObjects& objects, bool with_planes, SceneArrays& arrays) {
    std::uint32_t counts[primitive_kind_count] = {};
    for (const FlatObject& flat : objects.objects) {
        if (flat.kind == PrimitiveKind::triangle || (flat.kind == PrimitiveKind::plane && !with_planes)) continue;
        ++counts[index_of(flat.kind)];
    }
    std::uint32_t quadrics = 0;
    for (int kind = index_of(PrimitiveKind::sphere); kind < index_of(PrimitiveKind::plane); ++kind) quadrics += counts[kind];
    counts[index_of(PrimitiveKind::triangle)] = static_cast<std::uint32_t>(bounded.count) - quadrics;
    for (int kind = 0; kind < primitive_kind_count; ++kind) {
        arrays.first_slot[kind + 1] = arrays.first_slot[kind] + counts[kind];
        if (counts[kind] > 0) arrays.features |= feature_triangles << kind;
    }
}
static_assert(feature_planes == feature_triangles << static_cast<int>(PrimitiveKind::plane));

/// Several large arrays at once: most of the time goes into touching fresh memory.
void allocate_slots(SceneArrays& arrays, int threads) {
    const std::uint32_t* first = arrays.first_slot;
    const std::size_t slots = first[primitive_kind_count];
    arrays.spheres.resize(first[2] - first[1]);
    const std::size_t affines = first[index_of(PrimitiveKind::plane)] - first[2];
    arrays.affines.resize(affines);
    arrays.affine_shading.resize(affines);
    parallel_for(threads, 4, [&](std::size_t i) {
        if (i == 0) arrays.triangles.resize(first[1]);
        if (i == 1) arrays.scene_id.resize(slots);
        if (i == 2) arrays.object.resize(slots);
        if (i == 3) arrays.material.resize(slots);
    });
}

std::uint32_t leaf_count(std::uint64_t leaf) {
    return static_cast<std::uint32_t>(leaf >> child_count_shift & child_count_mask) + 1;
}

void set_attributes(const FlatObject& flat, const FlatMaterials& materials, std::uint32_t triangle, std::uint32_t slot,
                    SceneArrays& arrays) {
    arrays.scene_id[slot] = flat.first_scene_id + triangle;
    arrays.object[slot] = flat.index;
    arrays.material[slot] = material_of(materials, flat, triangle);
}

/// What leaves are filled from.
struct Sources {
    const FlatObjects& objects;
    const Bounded& bounded;
    const FlatMaterials& materials;
    const BvhTree& tree;
};

void fill_triangles(std::uint64_t leaf, const BuildRef* refs, const Sources& sources, SceneArrays& arrays) {
    const bool is_shared = (leaf >> child_kind_shift & child_kind_mask) == leaf_of_shared;
    const std::uint32_t count = leaf_count(leaf), first = static_cast<std::uint32_t>(leaf);
    TriangleRecord* records[max_leaf_size] = {};
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t slot = is_shared ? sources.tree.shared_slots[first + i] ^ first_here : first + i;
        if ((slot & first_here) != 0) continue; // filled from the leaf in which it comes first
        records[i] = &arrays.triangles[slot];
        set_attributes(sources.objects.objects[object_of(refs[i])], sources.materials, refs[i].item, slot, arrays);
    }
    write_triangle_leaf(sources.objects, sources.bounded.vertices, refs, count,
                        static_cast<std::uint32_t>(leaf >> child_block_shift & child_block_mask), arrays.arena.get(), records);
}

void fill_leaf(std::uint64_t leaf, const BuildRef* refs, const Sources& sources, SceneArrays& arrays) {
    const auto kind = static_cast<PrimitiveKind>(leaf >> child_kind_shift & child_kind_mask);
    if (kind == PrimitiveKind::triangle || (leaf >> child_kind_shift & child_kind_mask) == leaf_of_shared)
        return fill_triangles(leaf, refs, sources, arrays);
    const Quadrics& quadrics = sources.bounded.quadrics;
    const auto slot = static_cast<std::uint32_t>(leaf);
    for (std::uint32_t i = 0; i < leaf_count(leaf); ++i) {
        set_attributes(sources.objects.objects[object_of(refs[i])], sources.materials, 0, slot + i, arrays);
        if (kind == PrimitiveKind::sphere) arrays.spheres[slot + i - arrays.first_slot[1]] = quadrics.spheres[refs[i].item];
        if (kind >= PrimitiveKind::ellipsoid && kind < PrimitiveKind::plane) {
            arrays.affines[slot + i - arrays.first_slot[2]] = quadrics.affines[refs[i].item];
            arrays.affine_shading[slot + i - arrays.first_slot[2]] = quadrics.affine_shading[refs[i].item];
        }
    }
}

void add_planes(const FlatObjects& objects, const FlatMaterials& materials, SceneArrays& arrays) {
    const std::uint32_t first = arrays.first_slot[index_of(PrimitiveKind::plane)];
    for (const FlatObject& flat : objects.objects) {
        if (flat.kind != PrimitiveKind::plane) continue;
        set_attributes(flat, materials, 0, first + static_cast<std::uint32_t>(arrays.planes.size()), arrays);
        arrays.planes.push_back(plane_record(std::get<Plane>(flat.object->shape), arrays.normalisation));
    }
}

} // namespace

SceneArrays flatten(const SceneDescription& scene, const RenderSettings& settings, int threads) {
    const auto start = Clock::now();
    SceneArrays arrays;
    const FlatObjects objects = prepare_objects(scene);
    constexpr std::size_t worth_a_thread = 4096; // primitives: below, starting a thread takes longer than the work
    if (objects.refs < worth_a_thread) threads = 1;
    const Team team(threads);
    const std::vector<DoubleBox> boxes = bounds_of(objects, threads);
    DoubleBox bounds;
    for (const DoubleBox& box : boxes) include(bounds, box);
    arrays.bounds_min = bounds.lo;
    arrays.bounds_max = bounds.hi;
    arrays.normalisation = find_normalisation(bounds, scene, settings.planes);
    if (const auto warning = fine_object_warning(objects, boxes, arrays.normalisation)) arrays.warnings.push_back(*warning);
    const FlatMaterials materials = flatten_materials(objects, settings);
    arrays.materials = materials.records;
    arrays.features |= material_features(arrays.materials);
    flatten_lights(scene, settings, arrays);
    const bool spatial = settings.bvh == BvhMode::quality;
    const Bounded bounded = bake(objects, spatial, arrays, threads);
    number_slots(bounded, objects, settings.planes, arrays);
    arrays.bake_seconds = seconds_since(start);

    const auto build_start = Clock::now();
    const SpatialRoom room{[&](const BuildRef& ref) { return corners_of(objects, bounded.vertices, ref); },
                           [&](const BuildRef& ref) { return objects.objects[object_of(ref)].first_ref + ref.item; },
                           objects.refs, bounded.capacity};
    BvhTree tree = build_bvh(bounded.refs.get(), bounded.count, arrays.first_slot, spatial ? &room : nullptr, threads);
    arrays.arena = std::move(tree.arena);
    arrays.arena_bytes = tree.arena_bytes;
    arrays.leaves = std::move(tree.leaves);
    arrays.max_coordinate = tree.max_coordinate;
    arrays.build_seconds = seconds_since(build_start);

    const auto fill_start = Clock::now();
    allocate_slots(arrays, threads);
    const Sources sources{objects, bounded, materials, tree};
    for (const std::uint32_t slot : tree.shared_slots) arrays.shared_slots.push_back(slot & ~first_here);
    constexpr std::size_t piece = 1024;
    parallel_for(threads, piece_count(arrays.leaves.size(), piece), [&](std::size_t p) {
        for (std::size_t i = p * piece; i < std::min(arrays.leaves.size(), (p + 1) * piece); ++i)
            fill_leaf(arrays.leaves[i], bounded.refs.get() + tree.leaf_first_ref[i], sources, arrays);
    });
    if (settings.planes) add_planes(objects, materials, arrays);
    arrays.bake_seconds += seconds_since(fill_start);
    return arrays;
}

} // namespace lanecast
