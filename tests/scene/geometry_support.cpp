#include "scene/geometry_support.hpp"

#include "scene/bvh_quality.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace lanecast::test {

glm::dvec3 Random::direction() {
    for (;;) {
        const glm::dvec3 p = point(1);
        if (const double length = glm::length(p); length > 0.1 && length <= 1) return p / length;
    }
}

std::vector<Transformation> random_transformations(Random& random, bool similarity) {
    std::vector<Transformation> result;
    const int count = 1 + random.below(3);
    for (int i = 0; i < count; ++i) {
        switch (random.below(3)) {
        case 0:
            result.emplace_back(Rotation{random.direction(), random.uniform(-360, 360)});
            break;
        case 1:
            result.emplace_back(Translation{random.point(2)});
            break;
        default: {
            glm::dvec3 s(std::exp(random.uniform(-1, 1)));
            if (!similarity)
                s = {std::exp(random.uniform(-1, 1)), std::exp(random.uniform(-1, 1)), std::exp(random.uniform(-1, 1))};
            if (random.chance(0.3)) s[random.below(3)] *= -1;
            result.emplace_back(Scale{s});
        }
        }
    }
    return result;
}

Object make_object(const Shape& shape, std::vector<Transformation> transformations) {
    Object object;
    object.shape = shape;
    object.transformations = std::move(transformations);
    return object;
}

Mesh triangle_mesh(std::vector<std::array<glm::dvec3, 3>> triangles) {
    Mesh mesh;
    for (const auto& triangle : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), triangle.begin(), triangle.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

SceneDescription random_scene(Random& random, int size) {
    SceneDescription scene;
    const int layout = random.below(5), kinds = 1 + random.below(63);
    const double spacing = random.chance(0.5) ? 1 : std::exp(random.uniform(-5, 5));
    const glm::dvec3 line = random.direction(), where = random.point(1);
    const auto place = [&](int i) -> glm::dvec3 {
        switch (layout) {
        case 0:
            return where;
        case 1:
            return line * (spacing * i);
        case 2:
            return spacing * glm::dvec3(i % 4, i / 4 % 4, i / 16);
        case 3:
            return {spacing * random.below(3), 0, 0};
        default:
            return random.point(spacing * 3);
        }
    };
    for (int i = 0; i < size;) {
        const int kind = random.below(6);
        if ((kinds >> kind & 1) == 0) continue;
        Object object;
        object.material.diffuse = glm::dvec3(0.25 * random.below(4));
        if (random.chance(0.2)) object.transformations = random_transformations(random, random.chance(0.5));
        const double radius = random.chance(0.5) ? 0.5 : random.uniform(0.05, 1);
        if (kind == 0) object.shape = Sphere{radius, place(i)};
        if (kind == 1) {
            object.shape = Sphere{radius, glm::dvec3(0)};
            object.transformations = {Scale{{1, 2, 3}}, Rotation{random.direction(), 30}, Translation{place(i)}};
        }
        if (kind == 2) {
            object.shape = Cylinder{radius, random.uniform(0.1, 2), random.chance(0.7)};
            object.transformations.emplace_back(Translation{place(i)});
        }
        if (kind == 3) {
            object.transformations.clear();
            object.shape = Plane{place(i), random.direction() * random.uniform(0.1, 10)};
        }
        if (kind == 4) {
            const double apex = random.chance(0.4) ? 0 : random.chance(0.2) ? radius : random.uniform(0, 1);
            object.shape = Cone{radius, apex, random.uniform(0.1, 2), random.chance(0.5)};
            object.transformations.emplace_back(Translation{place(i)});
        }
        if (kind == 5) {
            std::vector<std::array<glm::dvec3, 3>> triangles;
            const int count = std::min(size - i, 1 + random.below(20));
            for (int t = 0; t < count; ++t) {
                const glm::dvec3 p = place(i + t);
                triangles.push_back({p, p + random.point(0.5), random.chance(0.05) ? p : p + random.point(0.5)});
            }
            object.shape = triangle_mesh(triangles);
            i += count - 1;
        }
        scene.objects.push_back(object);
        ++i;
    }
    return scene;
}

Mesh needles(Random& random, int count) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 p = random.point(1);
        const double width = std::exp(random.uniform(-9, 0));
        triangles.push_back({p, p + random.direction() * random.uniform(0.2, 2), p + random.direction() * width});
    }
    return triangle_mesh(triangles);
}

namespace {

struct Walk {
    const SceneArrays& arrays;
    std::string fault{};
    std::vector<int> seen{};
    std::vector<std::vector<std::array<float, 6>>> parts{}; ///< of triangles that may be split: boxes, by slot
    std::vector<std::uint64_t> leaves{};
    std::uint32_t next_slot[primitive_kind_count] = {};
    std::size_t next_unit = 0;
    std::uint32_t next_shared = 0;
    std::uint32_t nodes = 0;
    int depth = 0;

    void fail(const std::string& what) {
        if (fault.empty()) fault = what;
    }

    struct Bounds {
        double lo[3] = {-1e300, -1e300, -1e300}, hi[3] = {1e300, 1e300, 1e300};
    };

    void inside(const Bounds& box, const glm::dvec3& p, const char* what) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(p[axis] >= box.lo[axis] && p[axis] <= box.hi[axis])) fail(std::string(what) + " outside a box above it");
    }

    void quadric(const Bounds& box, std::uint32_t slot, PrimitiveKind kind) {
        const AffineRecord& r = arrays.affines[slot - arrays.first_slot[2]];
        glm::dmat3 object_from_world;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                object_from_world[column][row] = double{r.object_from_world[3 * row + column]};
        const glm::dmat3 world_from_object = glm::inverse(object_from_world);
        const glm::dvec3 t{r.translation[0], r.translation[1], r.translation[2]};
        Random random(slot);
        for (int i = 0; i < 40; ++i) {
            glm::dvec3 p = random.direction();
            if (kind != PrimitiveKind::ellipsoid) {
                const double angle = random.uniform(0, 7), y = random.chance(0.5) ? 0.5 : -0.5;
                const double radius = kind == PrimitiveKind::cylinder ? 1 : 1 + double{r.taper} * y;
                p = {radius * std::cos(angle), y, radius * std::sin(angle)};
            }
            inside(box, world_from_object * p + t, kind == PrimitiveKind::ellipsoid ? "an ellipsoid" : "a cylinder or cone");
        }
    }

    glm::dvec3 vertex(std::uint32_t record, std::uint32_t v) const {
        const std::uint32_t lane = record & 7u, n = (record >> 3 & 7u) + 1;
        const auto* rows = reinterpret_cast<const float*>(arrays.arena.get() + std::size_t{record >> 6} * 64) + lane;
        return {rows[(3 * v) * n], rows[(3 * v + 1) * n], rows[(3 * v + 2) * n]};
    }

    void triangle(const Bounds& box, std::uint64_t word, std::uint32_t lane, std::uint32_t n, std::uint32_t slot) {
        const auto block = static_cast<std::uint32_t>(word >> child_block_shift & 0x1ffffffu);
        const std::uint32_t record = block << 6 | (n - 1) << 3 | lane;
        if (arrays.shared_slots.empty()) {
            for (std::uint32_t v = 0; v < 3; ++v) inside(box, vertex(record, v), "a vertex");
        } else {
            parts.resize(arrays.first_slot[1]);
            std::array<float, 6> part{};
            for (std::size_t i = 0; i < 3; ++i)
                part[i] = static_cast<float>(box.lo[i]), part[3 + i] = static_cast<float>(box.hi[i]);
            parts[slot].push_back(part);
            for (std::uint32_t v = 0; v < 3; ++v)
                if (vertex(record, v) != vertex(arrays.triangles[slot].block, v)) fail("a part of another triangle");
        }
        if (seen[slot] == 1 && arrays.triangles[slot].block != record)
            fail("a triangle's record does not point to its first lane");
        if (std::size_t{block} * 64 + (8 * n + 8) * 4 > arrays.arena_bytes)
            fail("8 floats of the last row lie outside the arena");
    }

    /// Every point of a split triangle lies in one of its boxes: tried at the corners and at random, on the edges and between.
    void check_parts() {
        Random random(7);
        for (std::uint32_t slot = 0; slot < parts.size(); ++slot)
            for (int i = 0; i < 40; ++i) {
                double b[3] = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
                if (i < 20) b[i % 3] = 0;
                if (i < 3) b[0] = i == 0, b[1] = i == 1, b[2] = i == 2;
                glm::dvec3 p(0);
                for (std::uint32_t v = 0; v < 3; ++v)
                    p += vertex(arrays.triangles[slot].block, v) * (b[v] / (b[0] + b[1] + b[2]));
                const auto holds = [&](const std::array<float, 6>& part) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        const double x = p[static_cast<int>(k)];
                        if (x < double{part[k]} - 1e-12 || x > double{part[3 + k]} + 1e-12) return false;
                    }
                    return true;
                };
                if (std::none_of(parts[slot].begin(), parts[slot].end(), holds))
                    fail("a point of a triangle in none of its boxes");
            }
    }

    /// Triangles some of which were seen before, at the next place of the table.
    void shared_leaf(const Bounds& box, std::uint64_t word, std::uint32_t n, std::uint32_t first) {
        if ((word >> child_block_shift & 0x1ffffffu) != next_unit) fail("a block is not where the order puts it");
        next_unit += (36 * n + 63) / 64;
        if (first != next_shared || first + n > arrays.shared_slots.size()) return fail("shared slots are not in leaf order");
        next_shared += n;
        std::uint32_t again = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t slot = arrays.shared_slots[first + i];
            if (slot >= arrays.first_slot[1]) return fail("a slot of another kind");
            for (std::uint32_t j = 0; j < i; ++j)
                if (arrays.shared_slots[first + j] == slot) fail("a triangle twice in one leaf");
            if (seen[slot]++ > 0)
                ++again;
            else if (slot != next_slot[0]++)
                fail("slots are not in leaf order");
            triangle(box, word, i, n, slot);
        }
        if (again == 0) fail("a leaf of shared triangles without one");
    }

    void leaf(const Bounds& box, std::uint64_t word) {
        leaves.push_back(word);
        const auto kind = static_cast<int>(word >> child_kind_shift & 7u);
        const std::uint32_t n = static_cast<std::uint32_t>(word >> child_count_shift & 7u) + 1;
        const auto slot = static_cast<std::uint32_t>(word);
        if (kind == static_cast<int>(PrimitiveKind::plane) || kind > static_cast<int>(leaf_of_shared))
            return fail("a leaf of planes or of no kind");
        if (kind == static_cast<int>(leaf_of_shared)) return shared_leaf(box, word, n, slot);
        if (slot != next_slot[kind]) fail("slots are not in leaf order");
        next_slot[kind] = slot + n;
        if (kind == 0) {
            if ((word >> child_block_shift & 0x1ffffffu) != next_unit) fail("a block is not where the order puts it");
            next_unit += (36 * n + 63) / 64;
        } else if ((word >> child_block_shift & 0x1ffffffu) != 0) {
            fail("a leaf of quadrics has a block");
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            if (slot + i < arrays.first_slot[kind] || slot + i >= arrays.first_slot[kind + 1])
                return fail("a slot of another kind");
            ++seen[slot + i];
            if (kind == 0) triangle(box, word, i, n, slot + i);
            if (kind == 1) {
                const SphereRecord& s = arrays.spheres[slot + i - arrays.first_slot[1]];
                for (int axis = 0; axis < 3; ++axis)
                    for (const double sign : {-1.0, 1.0}) {
                        glm::dvec3 p{s.centre[0], s.centre[1], s.centre[2]};
                        p[axis] += sign * double{s.radius};
                        inside(box, p, "a sphere");
                    }
            }
            if (kind >= 2) quadric(box, slot + i, static_cast<PrimitiveKind>(kind));
        }
    }

    void node(const Bounds& above, std::uint64_t offset, int level) {
        if (offset != next_unit) fail("a node is not where the order puts it");
        next_unit += 4;
        ++nodes;
        depth = std::max(depth, level);
        const BvhNode& n = *reinterpret_cast<const BvhNode*>(arrays.arena.get() + offset * 64);
        const auto child_bounds = [&](int i) {
            Bounds box = above;
            for (int axis = 0; axis < 3; ++axis) {
                if (double{n.lo[axis][i]} < above.lo[axis] || double{n.hi[axis][i]} > above.hi[axis])
                    fail("a child's box outside its parent's");
                box.lo[axis] = double{n.lo[axis][i]}, box.hi[axis] = double{n.hi[axis][i]};
            }
            return box;
        };
        int used = 0;
        for (int i = 0; i < 8; ++i) {
            if (n.child[i] == 0) {
                for (int axis = 0; axis < 3; ++axis)
                    if (n.lo[axis][i] != 1e30f || n.hi[axis][i] != -1e30f) fail("an unused child can be entered");
                continue;
            }
            ++used;
            if ((n.child[i] & child_is_leaf) != 0) leaf(child_bounds(i), n.child[i]);
        }
        if (used < 2 && !(level == 1 && used == 1 && arrays.leaves.size() == 1)) fail("a node with too few children");
        for (int i = 0; i < 8; ++i)
            if (n.child[i] != 0 && (n.child[i] & child_is_leaf) == 0) node(child_bounds(i), n.child[i], level + 1);
    }
};

} // namespace

std::string check_tree(const SceneArrays& arrays) {
    Walk walk{arrays};
    const std::uint32_t planes = arrays.first_slot[6], slots = arrays.first_slot[7];
    walk.seen.assign(slots, 0);
    std::copy_n(arrays.first_slot, primitive_kind_count, walk.next_slot);
    if (arrays.scene_id.size() != slots || arrays.object.size() != slots || arrays.material.size() != slots)
        return "attributes: not one per slot";
    if (planes == 0) return arrays.leaves.empty() && arrays.arena_bytes == 0 ? "" : "a tree of nothing";
    if (arrays.leaves.empty()) return "no tree";
    walk.node({}, 0, 1);
    walk.check_parts();
    if (!walk.fault.empty()) return walk.fault;
    for (std::uint32_t slot = 0; slot < planes; ++slot)
        if (walk.seen[slot] != 1 && (walk.seen[slot] == 0 || slot >= arrays.first_slot[1] || arrays.shared_slots.empty()))
            return "slot " + std::to_string(slot) + " is in " + std::to_string(walk.seen[slot]) + " leaves";
    if (walk.next_shared != arrays.shared_slots.size()) return "shared slots that no leaf uses";
    if (walk.next_unit * 64 != arrays.arena_bytes) return "the arena has a remainder";
    const BvhQuality quality = measure_quality(arrays.arena.get());
    if (walk.depth > max_bvh_depth || walk.depth != quality.depth) return "depth";
    if (walk.nodes != quality.nodes || walk.leaves.size() != quality.leaves) return "counts of the quality report";
    if (walk.leaves != arrays.leaves) return "the list of leaves is not in arena order";
    for (std::uint32_t slot = 0; slot < slots; ++slot)
        if (arrays.material[slot] >= arrays.materials.size()) return "a material that does not exist";
    std::vector<std::uint32_t> ids = arrays.scene_id;
    std::sort(ids.begin(), ids.end());
    if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) return "two slots with one scene id";
    return "";
}

std::string difference(const SceneArrays& a, const SceneArrays& b) {
    if (a.arena_bytes != b.arena_bytes || (a.arena_bytes > 0 && std::memcmp(a.arena.get(), b.arena.get(), a.arena_bytes) != 0))
        return "arena";
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    if (!same(a.leaves, b.leaves)) return "leaves";
    if (!same(a.triangles, b.triangles)) return "triangles";
    if (!same(a.spheres, b.spheres)) return "spheres";
    if (!same(a.affines, b.affines)) return "affines";
    if (!same(a.affine_shading, b.affine_shading)) return "affine_shading";
    if (!same(a.planes, b.planes)) return "planes";
    if (!same(a.shared_slots, b.shared_slots)) return "shared_slots";
    if (!same(a.scene_id, b.scene_id) || !same(a.object, b.object) || !same(a.material, b.material)) return "attributes";
    if (!same(a.materials, b.materials)) return "materials";
    if (!same(a.lights, b.lights)) return "lights";
    if (std::memcmp(a.first_slot, b.first_slot, sizeof a.first_slot) != 0 || a.features != b.features)
        return "first_slot or features";
    if (std::memcmp(a.ambient, b.ambient, sizeof a.ambient) != 0 || a.max_coordinate != b.max_coordinate)
        return "ambient or max_coordinate";
    if (a.normalisation.exact != b.normalisation.exact || a.degenerate_triangles != b.degenerate_triangles)
        return "exact or dropped";
    return "";
}

} // namespace lanecast::test
