#include "scene/flatten_meshes.hpp"

#include "scene/bvh_collapse.hpp"
#include "scene/normalise.hpp"
#include "scene/parallel.hpp"
#include "scene/triangle_geometry.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>

namespace lanecast {
namespace {

constexpr std::size_t piece_size = 16384; ///< vertices or triangles that one thread takes at a time

/// Part of a mesh.
struct Piece {
    const FlatObject* object;
    const Mesh* mesh;
    std::size_t begin, end;
};

template <class Count>
std::vector<Piece> cut(const FlatObjects& objects, Count&& count) {
    std::vector<Piece> pieces;
    for (const FlatObject& flat : objects.objects)
        if (const auto* mesh = std::get_if<Mesh>(&flat.object->shape))
            for (std::size_t begin = 0; begin < count(*mesh); begin += piece_size)
                pieces.push_back({&flat, mesh, begin, std::min(count(*mesh), begin + piece_size)});
    return pieces;
}
std::vector<Piece> cut_vertices(const FlatObjects& objects) {
    return cut(objects, [](const Mesh& mesh) { return mesh.positions.size(); });
}
std::vector<Piece> cut_triangles(const FlatObjects& objects) {
    return cut(objects, [](const Mesh& mesh) { return mesh.triangles.size(); });
}

bool is_identity(const AffineTransform& t) { return t.linear == glm::dmat3(1) && t.translation == glm::dvec3(0); }

/// The positions of a piece in world units.
template <class Visit>
void for_each_world_position(const Piece& piece, Visit&& visit) {
    if (is_identity(piece.object->world_from_object)) {
        for (std::size_t i = piece.begin; i < piece.end; ++i) visit(i, piece.mesh->positions[i]);
    } else {
        for (std::size_t i = piece.begin; i < piece.end; ++i)
            visit(i, apply(piece.object->world_from_object, piece.mesh->positions[i]));
    }
}

/// Vertex indices by the winding in the world.
std::array<std::uint32_t, 3> wound(const Mesh& mesh, bool mirrored, std::uint32_t triangle) {
    std::array<std::uint32_t, 3> v = mesh.triangles[triangle];
    if (mirrored) std::swap(v[1], v[2]);
    return v;
}

Float4 magnitude(Float4 x) { return max4(x, -x); }

/// True where the cross product of two edges, in float, is larger than its rounding: 4 u (|p| + |q|) and what underflows. False
/// says nothing. Almost every triangle passes, and is_degenerate is not asked.
bool surely_has_area(Float4 a, Float4 b, Float4 c) {
    const Float4 u = b - a, v = c - a;
    const Float4 u_yzx = __builtin_shufflevector(u, u, 1, 2, 0, 3), u_zxy = __builtin_shufflevector(u, u, 2, 0, 1, 3);
    const Float4 v_yzx = __builtin_shufflevector(v, v, 1, 2, 0, 3), v_zxy = __builtin_shufflevector(v, v, 2, 0, 1, 3);
    const Float4 p = u_yzx * v_zxy, q = u_zxy * v_yzx;
    const Int4 sure = magnitude(p - q) > (magnitude(p) + magnitude(q)) * 0x1p-21f + 0x1p-100f;
    return (sure[0] | sure[1] | sure[2]) != 0;
}

} // namespace

std::vector<DoubleBox> mesh_bounds(const FlatObjects& objects, int threads) {
    // Which vertices are used: several threads may set the same byte.
    const auto is_used = std::make_unique<unsigned char[]>(objects.vertices);
    const std::vector<Piece> triangles = cut_triangles(objects);
    parallel_for(threads, triangles.size(), [&](std::size_t p) {
        unsigned char* const own = is_used.get() + triangles[p].object->first_vertex;
        for (std::size_t i = triangles[p].begin; i < triangles[p].end; ++i)
            for (const std::uint32_t v : triangles[p].mesh->triangles[i])
                std::atomic_ref(own[v]).store(1, std::memory_order_relaxed);
    });
    const std::vector<Piece> vertices = cut_vertices(objects);
    std::vector<DoubleBox> boxes(vertices.size());
    parallel_for(threads, vertices.size(), [&](std::size_t p) {
        const unsigned char* const own = is_used.get() + vertices[p].object->first_vertex;
        DoubleBox box;
        for_each_world_position(vertices[p], [&](std::size_t i, const glm::dvec3& position) {
            if (own[i]) include(box, position);
        });
        boxes[p] = box;
    });
    std::vector<DoubleBox> bounds(objects.objects.size());
    for (std::size_t p = 0; p < boxes.size(); ++p) include(bounds[vertices[p].object->index], boxes[p]);
    return bounds;
}

BakedVertices bake_vertices(const FlatObjects& objects, const Normalisation& normalisation, int threads) {
    BakedVertices baked;
    baked.positions = make_scratch<std::array<float, 4>>(objects.vertices);
    const std::vector<Piece> pieces = cut_vertices(objects);
    std::atomic<bool> exact = true;
    parallel_for(threads, pieces.size(), [&](std::size_t p) {
        std::array<float, 4>* const own = baked.positions.get() + pieces[p].object->first_vertex;
        bool piece_exact = true;
        for_each_world_position(pieces[p], [&](std::size_t i, const glm::dvec3& position) {
            const glm::dvec3 n = normalised(normalisation, position);
            // Vertices that no triangle uses may lie outside [-1, 1], and do not count there.
            if (piece_exact && !is_exact(normalisation, position))
                piece_exact = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) > 1;
            // + 0 makes -0 to 0: equal vertices are then equal in their bits.
            own[i] = {static_cast<float>(n.x) + 0.0f, static_cast<float>(n.y) + 0.0f, static_cast<float>(n.z) + 0.0f, 0.0f};
        });
        if (!piece_exact) exact = false;
    });
    baked.exact = exact;
    return baked;
}

std::vector<std::uint32_t> add_triangles(const FlatObjects& objects, const BakedVertices& vertices, BuildRef* refs, int threads) {
    const std::vector<Piece> pieces = cut_triangles(objects);
    std::vector<std::vector<std::uint32_t>> degenerate(pieces.size());
    parallel_for(threads, pieces.size(), [&](std::size_t p) {
        const Piece& piece = pieces[p];
        const std::array<float, 4>* const positions = vertices.positions.get() + piece.object->first_vertex;
        BuildRef* const own = refs + piece.object->first_ref;
        const std::uint32_t source =
            piece.object->index << source_object_shift | static_cast<std::uint32_t>(PrimitiveKind::triangle);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            const auto& triangle = piece.mesh->triangles[i];
            const float *a = positions[triangle[0]].data(), *b = positions[triangle[1]].data(),
                        *c = positions[triangle[2]].data();
            const Float4 va = load_xyz(a), vb = load_xyz(b), vc = load_xyz(c);
            const Float4 lo = min4(min4(va, vb), vc), hi = max4(max4(va, vb), vc);
            BuildRef ref;
            std::memcpy(ref.lo, &lo, sizeof ref.lo);
            std::memcpy(ref.hi, &hi, sizeof ref.hi);
            ref.item = static_cast<std::uint32_t>(i);
            ref.source = source;
            own[i] = ref;
            if (!surely_has_area(va, vb, vc) && is_degenerate(a, b, c))
                degenerate[p].push_back(static_cast<std::uint32_t>(piece.object->first_ref + i));
        }
    });
    std::vector<std::uint32_t> all;
    for (const auto& own : degenerate) all.insert(all.end(), own.begin(), own.end());
    return all;
}

std::array<const float*, 3> corners_of(const FlatObjects& objects, const BakedVertices& vertices, const BuildRef& ref) {
    const FlatObject& flat = objects.objects[object_of(ref)];
    const auto& triangle = std::get<Mesh>(flat.object->shape).triangles[ref.item];
    const auto* const own = vertices.positions.get() + flat.first_vertex;
    return {own[triangle[0]].data(), own[triangle[1]].data(), own[triangle[2]].data()};
}

void write_triangle_leaf(const FlatObjects& objects, const BakedVertices& vertices, const BuildRef* refs, std::uint32_t n,
                         std::uint32_t block_offset, unsigned char* arena, TriangleRecord* const* records) {
    auto* const rows = reinterpret_cast<float*>(arena + std::size_t{block_offset} * 64);
    const float* corner[max_leaf_size][3];
    for (std::uint32_t lane = 0; lane < n; ++lane) { // only look-ups, so that their cache misses overlap
        const FlatObject& flat = objects.objects[object_of(refs[lane])];
        const auto indices = wound(std::get<Mesh>(flat.object->shape), flat.mirrored, refs[lane].item);
        for (std::size_t v = 0; v < 3; ++v) corner[lane][v] = vertices.positions[flat.first_vertex + indices[v]].data();
    }
    for (std::uint32_t lane = 0; lane < n; ++lane) {
        const auto& [v0, v1, v2] = corner[lane];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            rows[axis * n + lane] = v0[axis];
            rows[(3 + axis) * n + lane] = v1[axis];
            rows[(6 + axis) * n + lane] = v2[axis];
        }
        if (records[lane] == nullptr) continue;
        triangle_normal(v0, v1, v2, records[lane]->normal);
        records[lane]->block = block_offset << 6 | (n - 1) << 3 | lane;
    }
    std::fill(rows + 9 * n, rows + 16 * block_units(n), 0.0f); // the same bytes every time
}

} // namespace lanecast
