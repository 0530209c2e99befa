// N1, N2: no ray gets out of a closed mesh through an edge or a vertex; by every triangle, and through the tree.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/rays.hpp"

namespace lanecast::selftest {
namespace {

enum class Aim { edges, vertices };

bool lies_along_axes(const glm::dmat3& linear) {
    return linear[0][1] == 0 && linear[0][2] == 0 && linear[1][0] == 0 && linear[1][2] == 0 && linear[2][0] == 0 &&
           linear[2][1] == 0;
}

/// A direction with two zeros, from beside the target; only where the sides of the box are along the axes.
bool along_axis(const MeshScene& scene, const glm::dvec3& target, Random& random, glm::dvec3& eye) {
    const glm::dvec3 centre = scene.place(glm::dvec3(0));
    const glm::dvec3 size = glm::abs(scene.place(glm::dvec3(1)) - centre);
    int across = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = std::fabs(target[axis] - centre[axis]) / size[axis];
        if (side > 0.999 && across >= 0) return false; // on an edge of the box: from beside it there is no inside
        if (side > 0.999) across = axis;
    }
    if (across < 0) return false;
    eye = target;
    eye[across] = centre[across] + size[across] * random.uniform(-0.9, 0.9);
    return true;
}

/// Rays from within, at random points of edges or at vertices. Neighbours go from one eye to the edges of one place.
Rays aimed_rays(const MeshScene& scene, Aim aim, std::uint64_t count, Random& random) {
    const auto triangles = static_cast<int>(scene.arrays.first_slot[1]);
    const bool has_axes = scene.form == Form::gridded_box && lies_along_axes(scene.world_from_object.linear);
    Rays rays;
    glm::dvec3 eye(0);
    int place = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (i % 64 == 0) {
            eye = scene.place(inner_point(scene.form, random));
            place = random.below(triangles);
        }
        // slots lie in leaf order, so near numbers are near in space
        const auto slot = static_cast<std::uint32_t>((place + random.below(16)) % triangles);
        const auto edge = static_cast<std::uint32_t>(random.below(3));
        const glm::dvec3 a = corner(scene.arrays, slot, edge), b = corner(scene.arrays, slot, (edge + 1) % 3);
        const glm::dvec3 target = aim == Aim::edges ? a + (b - a) * random.uniform(0, 1) : a;
        glm::dvec3 from = eye;
        if (has_axes && random.chance(0.3)) static_cast<void>(along_axis(scene, target, random, from));
        const glm::dvec3 start(static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(from.z));
        const glm::dvec3 d = target - start;
        rays.add(start, random.chance(0.5) ? d : d / glm::length(d));
    }
    return rays;
}

void count_leaks(const Block& block, Aim aim, bool tree, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const auto form = static_cast<Form>(random.below(form_count));
    // brute force takes a triangle's time per triangle; a tree should have some levels
    const int detail = form == Form::gridded_box ? (tree ? 12 : 4) : (tree ? 24 : 8);
    const MeshScene scene = make_mesh_scene(form, detail, s.placing, tree ? s.leaf_size : 0, random);
    Rays rays = aimed_rays(scene, aim, block.rays, random);
    if (s.path == Path::mixed) shuffle(rays, random.bits());
    const SceneView view = lanecast::view(scene.arrays);
    const Hits hits = ask(*s.kernels, view, rays, s.path, Query::closest, !tree);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool met = hits.slot[i] >= 0 && static_cast<std::uint32_t>(hits.slot[i]) < scene.arrays.first_slot[1];
        if (!met)
            tally.fail("form " + std::to_string(static_cast<int>(form)) + ", ray " + std::to_string(i) + " of " +
                       std::to_string(scene.arrays.first_slot[1]) + " triangles, " +
                       std::to_string(scene.arrays.degenerate_triangles) + " dropped as degenerate");
    }
    tally.rays += rays.size();
}

} // namespace

void test_leaks_at_edges(const Block& block, Tally& tally) { count_leaks(block, Aim::edges, false, tally); }
void test_leaks_at_vertices(const Block& block, Tally& tally) { count_leaks(block, Aim::vertices, false, tally); }
void test_tree_leaks_at_edges(const Block& block, Tally& tally) { count_leaks(block, Aim::edges, true, tally); }
void test_tree_leaks_at_vertices(const Block& block, Tally& tally) { count_leaks(block, Aim::vertices, true, tally); }

} // namespace lanecast::selftest
