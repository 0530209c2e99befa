// The tree over whole scenes: complete, conservative, ordered, bounded in depth, the same for any number of threads.

#include "scene/build_bvh.hpp"
#include "scene/bvh_binary.hpp"
#include "scene/bvh_quality.hpp"
#include "scene/geometry_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lanecast;
using namespace lanecast::test;

namespace {

Object sphere_at(const glm::dvec3& position, double radius) { return make_object(Sphere{radius, position}); }

Object triangles_in_cube(Random& random, int count, double size) {
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 p = random.point(1);
        triangles.push_back({p, p + random.point(size), p + random.point(size)});
    }
    return make_object(triangle_mesh(triangles));
}

BvhQuality quality_of(const SceneArrays& arrays) { return measure_quality(arrays.arena.get()); }

/// Primitives in leaves, those that stand in several counted each time.
std::uint32_t references(const SceneArrays& arrays) {
    std::uint32_t sum = 0;
    for (std::uint32_t n = 1; n <= max_leaf_size; ++n) sum += n * quality_of(arrays).leaf_sizes[n];
    return sum;
}

} // namespace

TEST_CASE("every primitive is in one leaf and inside every box above it") {
    Random random(1);
    int mixed = 0;
    for (int i = 0; i < 3000; ++i) {
        const SceneDescription scene = random_scene(random, 1 + random.below(i % 10 == 0 ? 300 : 40));
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        INFO("scene " << i);
        REQUIRE(check_tree(arrays) == "");
        mixed += (arrays.features & feature_triangles) != 0 && (arrays.features & feature_spheres) != 0 ? 1 : 0;
    }
    CHECK(mixed > 300);
}

TEST_CASE("a hundred thousand random triangles, within the memory promised") {
    Random random(2);
    SceneDescription scene;
    scene.objects.push_back(triangles_in_cube(random, 100000, 0.02));
    const SceneArrays arrays = flatten(scene, scene.render, 2);
    CHECK(check_tree(arrays) == "");
    CHECK(memory_bytes(arrays) < 100 * 100000);
    CHECK(quality_of(arrays).depth < 14);
    CHECK(quality_of(arrays).sah_cost < 110);
}

TEST_CASE("a tenth of a million equal spheres, and one primitive, and none") {
    SceneDescription scene;
    CHECK(check_tree(flatten(scene, scene.render, 2)) == "");
    scene.objects.push_back(sphere_at({1, 2, 3}, 0.5));
    const SceneArrays one = flatten(scene, scene.render, 1);
    CHECK(check_tree(one) == "");
    CHECK(quality_of(one).nodes == 1);
    CHECK(quality_of(one).leaves == 1);
    for (int i = 1; i < 100000; ++i) scene.objects.push_back(scene.objects[0]);
    const SceneArrays many = flatten(scene, scene.render, 2);
    CHECK(check_tree(many) == "");
    CHECK(quality_of(many).depth <= 17);
}

TEST_CASE("the same bytes for one to four threads") {
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const SceneDescription scene = random_scene(random, 200);
        const SceneArrays one = flatten(scene, scene.render, 1);
        for (int threads = 2; threads <= 4; ++threads) REQUIRE(difference(one, flatten(scene, scene.render, threads)) == "");
    }
    SceneDescription scene = random_scene(random, 300); // large enough for shared binning and for tasks
    scene.objects.push_back(triangles_in_cube(random, 150000, 0.05));
    scene.objects.push_back(triangles_in_cube(random, 30000, 0.5));
    const SceneArrays one = flatten(scene, scene.render, 1);
    CHECK(check_tree(one) == "");
    for (int threads = 2; threads <= 4; ++threads) CHECK(difference(one, flatten(scene, scene.render, threads)) == "");
}

TEST_CASE("spatial splits: every point of a triangle in some leaf, the same bytes for one to four threads") {
    Random random(4);
    int split = 0;
    for (int i = 0; i < 300; ++i) {
        SceneDescription scene = random_scene(random, 1 + random.below(60));
        if (i % 2 == 0) scene.objects.push_back(make_object(needles(random, 1 + random.below(400))));
        scene.render.bvh = BvhMode::quality;
        const SceneArrays arrays = flatten(scene, scene.render, 1);
        INFO("scene " << i);
        REQUIRE(check_tree(arrays) == "");
        if (arrays.shared_slots.empty()) continue;
        ++split;
        CHECK(static_cast<double>(references(arrays)) <= 1.3 * arrays.first_slot[4]);
    }
    CHECK(split > 60);

    SceneDescription scene = random_scene(random, 100); // large enough for tasks
    scene.objects.push_back(make_object(needles(random, 40000)));
    scene.render.bvh = BvhMode::quality;
    const SceneArrays one = flatten(scene, scene.render, 1);
    CHECK(check_tree(one) == "");
    CHECK(references(one) > one.first_slot[4] + 500);
    for (int threads = 2; threads <= 4; ++threads) CHECK(difference(one, flatten(scene, scene.render, threads)) == "");
    scene.render.bvh = BvhMode::standard;
    CHECK(quality_of(one).sah_cost < 0.98 * quality_of(flatten(scene, scene.render, 2)).sah_cost);
}

TEST_CASE("parts of a chopped triangle: within the reference, with every point of it") {
    Random random(6);
    for (int i = 0; i < 20000; ++i) {
        float v[3][4] = {}; // four floats of each may be read
        BuildRef ref{};
        for (int axis = 0; axis < 3; ++axis) {
            for (auto& corner : v) corner[axis] = static_cast<float>(random.uniform(-1, 1));
            ref.lo[axis] = std::min({v[0][axis], v[1][axis], v[2][axis]});
            ref.hi[axis] = std::max({v[0][axis], v[1][axis], v[2][axis]});
        }
        BuildRef rest = ref;
        std::vector<BuildRef> parts;
        for (int cut = 0; cut < 4; ++cut) { // of what is left, alternately below and above
            const int axis = random.below(3);
            BuildRef halves[2];
            const auto x = static_cast<float>(random.uniform(rest.lo[axis], rest.hi[axis]));
            const unsigned used = chop(rest, {v[0], v[1], v[2]}, axis, x, halves);
            REQUIRE(used != 0);
            const int keep = used == 3 ? random.below(2) : used == 1 ? 0 : 1;
            if (used == 3) parts.push_back(halves[1 - keep]);
            for (int k = 0; k < 3; ++k) REQUIRE((halves[keep].lo[k] >= rest.lo[k] && halves[keep].hi[k] <= rest.hi[k]));
            rest = halves[keep];
        }
        parts.push_back(rest);
        for (int n = 0; n < 20; ++n) {
            double b[3] = {random.uniform(0, 1), random.uniform(0, 1), n % 2 == 0 ? 0.0 : random.uniform(0, 1)};
            const double sum = b[0] + b[1] + b[2];
            const auto holds = [&](const BuildRef& part) {
                for (int axis = 0; axis < 3; ++axis) {
                    const double x = (b[0] * double{v[0][axis]} + b[1] * double{v[1][axis]} + b[2] * double{v[2][axis]}) / sum;
                    if (x < double{part.lo[axis]} - 1e-12 || x > double{part.hi[axis]} + 1e-12) return false;
                }
                return true;
            };
            REQUIRE(std::any_of(parts.begin(), parts.end(), holds));
        }
    }
}

TEST_CASE("depth is bounded where the area heuristic alone goes deeper") {
    // Boxes at 2^-k on each of three axes: every cut peels off a few of one axis.
    std::vector<BuildRef> refs;
    for (int k = 0; k < 120; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            BuildRef ref{};
            const float x = std::ldexp(1.0f, -k);
            for (int i = 0; i < 3; ++i) ref.lo[i] = (i == axis ? 0.9f : -0.1f) * x, ref.hi[i] = (i == axis ? 1.1f : 0.1f) * x;
            ref.item = static_cast<std::uint32_t>(refs.size());
            refs.push_back(ref);
        }
    const BinaryTree tree = build_binary(refs.data(), refs.size(), nullptr, 1);
    std::vector<int> seen(refs.size());
    int depth = 0;
    const auto walk = [&](const auto& self, std::uint32_t index, int inner_above) -> void {
        const BinaryNode& node = tree.nodes[index];
        if (!is_leaf(node)) {
            depth = std::max(depth, inner_above + 1);
            self(self, node.children, inner_above + 1);
            self(self, node.children + 1, inner_above + 1);
            return;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) ++seen[refs[i].item];
    };
    walk(walk, 0, 0);
    CHECK(depth <= max_bvh_depth);
    CHECK(depth > max_bvh_depth - 8); // the limit was felt
    CHECK(std::count(seen.begin(), seen.end(), 1) == static_cast<std::ptrdiff_t>(refs.size()));

    const std::uint32_t first_slot[primitive_kind_count + 1] = {0, 360, 360, 360, 360, 360, 360, 360};
    CHECK(measure_quality(build_bvh(refs.data(), refs.size(), first_slot, nullptr, 1).arena.get()).depth <= max_bvh_depth);
}

TEST_CASE("nodes have several children even where areas underflow") {
    Random random(5);
    std::vector<std::array<glm::dvec3, 3>> triangles{{glm::dvec3(-1, -1, -1), glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 0)}};
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 p = random.point(1e-24);
        triangles.push_back({p, p + random.point(1e-25), p + random.point(1e-25)});
    }
    SceneDescription scene;
    scene.objects.push_back(make_object(triangle_mesh(triangles)));
    const SceneArrays arrays = flatten(scene, {}, 1);
    CHECK(check_tree(arrays) == "");
    CHECK(arrays.triangles.size() == 3001);
    CHECK(quality_of(arrays).nodes < 500);
}

TEST_CASE("leaves: up to eight of one kind where splitting does not pay, never two kinds") {
    SceneDescription scene;
    for (int i = 0; i < 8; ++i) scene.objects.push_back(sphere_at({0, 0, 0}, 1));
    CHECK(quality_of(flatten(scene, {}, 1)).leaf_sizes[8] == 1);
    scene.objects.push_back(sphere_at({0, 0, 0}, 1));
    CHECK(quality_of(flatten(scene, {}, 1)).leaves == 2);

    scene.objects.clear();
    for (int i = 0; i < 8; ++i) scene.objects.push_back(sphere_at({300.0 * i, 0, 0}, 1)); // clearly apart
    CHECK(quality_of(flatten(scene, {}, 1)).leaf_sizes[1] == 8);
    scene.objects.clear();
    for (int i = 0; i < 8; ++i) scene.objects.push_back(sphere_at({0.1 * i, 0, 0}, 1)); // hardly
    CHECK(quality_of(flatten(scene, {}, 1)).leaves == 1);

    for (const int each : {4, 40}) { // small ranges and binned ones
        scene.objects.clear();
        for (int i = 0; i < each; ++i) {
            scene.objects.push_back(sphere_at({0, 0, 0}, 1));
            scene.objects.push_back(make_object(Cylinder{1, 2}));
        }
        const SceneArrays mixed = flatten(scene, {}, 1);
        CHECK(check_tree(mixed) == "");
        if (each == 4) CHECK(quality_of(mixed).leaves == 2);
        CHECK(quality_of(mixed).leaves <= static_cast<std::uint32_t>(each));
    }
}

TEST_CASE("quality of trees made by hand") {
    SceneDescription scene;
    scene.objects.push_back(sphere_at({0, 0, 0}, 1));
    const SceneArrays one = flatten(scene, scene.render, 1);
    CHECK(quality_of(one).sah_cost == doctest::Approx(2)); // one node, one test
    CHECK(quality_of(one).overlapping_share == 0);
    CHECK(quality_of(one).leaf_sizes[1] == 1);

    scene.objects.push_back(sphere_at({98, 0, 0}, 1)); // boxes of edge 2 in one of 100 x 2 x 2
    const SceneArrays two = flatten(scene, scene.render, 1);
    CHECK(quality_of(two).leaves == 2);
    CHECK(quality_of(two).sah_cost == doctest::Approx(1 + 2 * 12.0 / 404).epsilon(1e-3));

    BvhNode node{};
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis) node.lo[axis][i] = 1e30f, node.hi[axis][i] = -1e30f;
    CHECK_FALSE(children_overlap(node));
    const auto set = [&node](int i, float lo, float hi, float top) {
        node.lo[0][i] = lo, node.hi[0][i] = hi;
        node.lo[1][i] = 0, node.hi[1][i] = 1;
        node.lo[2][i] = 0, node.hi[2][i] = top;
    };
    set(0, 0, 4, 1);
    set(5, 3.5f, 4.5f, 1); // half of it inside: not more than half
    CHECK_FALSE(children_overlap(node));
    set(5, 3.25f, 4.25f, 1);
    CHECK(children_overlap(node));
    set(5, 3.25f, 4.25f, 0); // flat, and three quarters of its area inside
    CHECK(children_overlap(node));
    set(5, 4.25f, 5, 0);
    CHECK_FALSE(children_overlap(node));
}
