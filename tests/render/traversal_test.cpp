// Tree = brute force, every ISA = scalar, bit for bit, on rays of every coherence; and what rays that are not rays do.

#include "cli/selftest/scenes.hpp"
#include "render/ray_support.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

/// Up to 2000 rays of one of the selftest's kinds; every one has a range.
Rays random_rays(Random& random, const SceneArrays& scene, double farthest = 1e6) {
    const int n = 1 + random.below(random.chance(0.5) ? 40 : 2000);
    selftest::Random source(random.engine());
    Rays rays = selftest::random_rays(scene, static_cast<std::uint64_t>(n), farthest, source);
    while (rays.tmin.size() < rays.size()) rays.add_range(0, std::numeric_limits<float>::infinity());
    return rays;
}

struct Tally {
    std::uint64_t rays = 0, hits = 0;
};

/// Compares every table's tree and brute force with the scalar brute force; "" or the first difference.
std::string check_all(const SceneArrays& arrays, const Rays& rays, Tally& tally) {
    const SceneView scene = view(arrays);
    const Hits truth = ask(scalar_kernels(), scene, rays, Query::closest, true);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ++tally.rays;
        tally.hits += truth.slot[i] >= 0;
        if (truth.slot[i] >= 0 && !(truth.t[i] > rays.tmin[i] && truth.t[i] <= rays.tmax[i])) return "t outside its range";
        if (truth.slot[i] < 0 && bits_of(truth.t[i]) != bits_of(rays.tmax[i])) return "t of a miss is not tmax";
    }
    for (const KernelTable* kernels : balanced_kernels()) {
        for (const bool brute_force : {false, true}) {
            const std::string name = std::string(kernels->isa) + (brute_force ? " brute force" : " tree");
            const Hits hits = ask(*kernels, scene, rays, Query::closest, brute_force);
            const Hits shadow = ask(*kernels, scene, rays, Query::any, brute_force);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const std::string place = name + ", ray " + std::to_string(i) + " of " + std::to_string(rays.size());
                if (hits.slot[i] != truth.slot[i])
                    return place + ": slot " + std::to_string(hits.slot[i]) + " instead of " + std::to_string(truth.slot[i]);
                if (bits_of(hits.t[i]) != bits_of(truth.t[i])) return place + ": t differs";
                if ((shadow.slot[i] >= 0) != (truth.slot[i] >= 0)) return place + ": any_hit differs from closest_hit";
            }
        }
    }
    return "";
}

void check_scene(Random& random, const SceneDescription& description, int batches, Tally& tally, double farthest = 1e6) {
    const SceneArrays arrays = flatten(description, RenderSettings{}, 1);
    for (int batch = 0; batch < batches; ++batch) REQUIRE(check_all(arrays, random_rays(random, arrays, farthest), tally) == "");
}

} // namespace

TEST_CASE("the tree finds what testing every primitive finds: random scenes of all kinds") {
    Random random(1);
    Tally tally;
    for (int n = 0; n < cases(400); ++n)
        check_scene(random, random_scene(random, 1 + random.below(n % 10 == 0 ? 300 : 40)), 4, tally);
    CHECK(tally.hits > tally.rays / 20);
    MESSAGE(tally.rays, " rays, ", tally.hits, " hits");
}

TEST_CASE("the tree finds what testing every primitive finds: scenes far from the origin, huge and tiny") {
    Random random(2);
    Tally tally;
    for (int n = 0; n < cases(100); ++n) {
        SceneDescription scene = random_scene(random, 1 + random.below(60));
        const glm::dvec3 away = random.direction() * std::exp(random.uniform(-10, 10)) * (n % 2 == 0 ? 1.0 : 0.0);
        for (Object& object : scene.objects)
            if (!std::holds_alternative<Plane>(object.shape)) object.transformations.emplace_back(Translation{away});
        check_scene(random, selftest::scaled_scene(scene, random.below(121) - 60), 4, tally);
    }
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("the tree finds what testing every primitive finds: a grid of flat boxes, vertices on box planes") {
    Random random(3);
    Tally tally;
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (int x = -8; x < 8; ++x)
        for (int z = -8; z < 8; ++z) {
            const glm::dvec3 p(x * 0.125, 0.25, z * 0.125), ex(0.125, 0, 0), ez(0, 0, 0.125);
            triangles.push_back({p, p + ex, p + ex + ez});
            triangles.push_back({p, p + ex + ez, p + ez});
        }
    SceneDescription scene;
    scene.objects.push_back({triangle_mesh(triangles), {}, {}, ""});
    scene.objects.push_back({triangle_mesh(triangles), {Rotation{{1, 0, 0}, 90}}, {}, ""});
    scene.objects.push_back({triangle_mesh(triangles), {Rotation{{0, 0, 1}, 90}, Translation{{0.5, 0, 0}}}, {}, ""});
    check_scene(random, scene, cases(120), tally);
    CHECK(tally.hits > tally.rays / 10);
}

TEST_CASE("the tree finds what testing every primitive finds: stretched and sheared bodies") {
    Random random(4);
    Tally tally;
    for (int n = 0; n < cases(200); ++n) {
        SceneDescription scene;
        for (int i = 0; i < 12; ++i) {
            const Shape shapes[] = {
                Sphere{}, Cylinder{}, Cylinder{1, 1, false}, Cone{}, Cone{1, 0.5, 1, false}, Cone{1, 0, 1, false}};
            Object object{shapes[random.below(6)], {}, {}, ""};
            // condition numbers up to about 1e3 by stretching, and the shear that two stretches make
            const auto stretch = [&] { return std::exp(random.uniform(-3.4, 3.4)); };
            object.transformations = {Scale{{stretch(), stretch(), stretch()}}, Rotation{random.direction(), 50}};
            if (n % 2 == 0) object.transformations.emplace_back(Scale{{stretch(), stretch(), stretch()}});
            object.transformations.emplace_back(Rotation{random.direction(), 50});
            object.transformations.emplace_back(Translation{random.point(20)});
            scene.objects.push_back(object);
        }
        check_scene(random, scene, 4, tally, 5);
    }
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("spatial splits change no hit: random scenes and needles, rays aimed at edges and vertices") {
    Random random(8);
    Tally tally;
    int split = 0;
    for (int n = 0; n < cases(300); ++n) {
        SceneDescription scene = random_scene(random, 1 + random.below(60));
        if (n % 3 != 0) scene.objects.push_back({needles(random, 20 + random.below(300)), {}, {}, ""});
        const SceneArrays plain = flatten(scene, RenderSettings{}, 1);
        RenderSettings quality;
        quality.bvh = BvhMode::quality;
        const SceneArrays arrays = flatten(scene, quality, 1);
        split += arrays.shared_slots.empty() ? 0 : 1;
        for (int batch = 0; batch < 3; ++batch) {
            const Rays rays = random_rays(random, plain);
            REQUIRE(check_all(arrays, rays, tally) == "");
            const Hits a = ask(scalar_kernels(), view(plain), rays, Query::closest, true);
            const Hits b = ask(*balanced_kernels().back(), view(arrays), rays, Query::closest);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                REQUIRE(bits_of(a.t[i]) == bits_of(b.t[i]));
                REQUIRE((a.slot[i] < 0) == (b.slot[i] < 0));
                if (a.slot[i] >= 0)
                    REQUIRE(plain.scene_id[static_cast<std::size_t>(a.slot[i])] ==
                            arrays.scene_id[static_cast<std::size_t>(b.slot[i])]);
            }
        }
    }
    CHECK(split > cases(300) / 5);
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("the tree finds what testing every primitive finds: rays that end at one point, on surfaces and beyond the scene") {
    Random random(9);
    selftest::Random source(random.engine());
    Tally tally;
    for (int n = 0; n < cases(600); ++n) {
        SceneDescription scene = random_scene(random, 1 + random.below(60));
        if (n % 3 == 0) scene.objects.push_back({needles(random, 20 + random.below(300)), {}, {}, ""});
        const SceneArrays arrays = flatten(scene, RenderSettings{}, 1);
        for (int batch = 0; batch < 4; ++batch) {
            const auto count = static_cast<std::uint64_t>(1 + random.below(random.chance(0.5) ? 40 : 2000));
            REQUIRE(check_all(arrays, selftest::rays_to_lamp(arrays, count, source), tally) == "");
        }
    }
    CHECK(tally.hits > tally.rays / 5);
    CHECK(tally.hits < tally.rays / 10 * 9);
}

TEST_CASE("coincident primitives: the smaller scene id is hit, whatever the tree, packet and ISA") {
    Random random(5);
    Tally tally;
    for (int n = 0; n < cases(100); ++n) {
        SceneDescription scene = random_scene(random, 1 + random.below(40));
        const std::size_t objects = scene.objects.size();
        for (int copy = 0; copy < 2; ++copy)
            for (std::size_t i = 0; i < objects; ++i) scene.objects.push_back(Object(scene.objects[objects - 1 - i]));
        const SceneArrays arrays = flatten(scene, RenderSettings{}, 1);
        for (int batch = 0; batch < 3; ++batch) {
            const Rays rays = random_rays(random, arrays);
            REQUIRE(check_all(arrays, rays, tally) == "");
            const Hits hits = ask(*balanced_kernels().back(), view(arrays), rays, Query::closest);
            for (const std::int32_t slot : hits.slot)
                if (slot >= 0) REQUIRE(arrays.object[static_cast<std::size_t>(slot)] < objects);
        }
    }
    CHECK(tally.hits > tally.rays / 20);
}

TEST_CASE("rays that are not finite or have no direction miss, and change no other ray") {
    Random random(6);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (int n = 0; n < cases(200); ++n) {
        const SceneArrays arrays = flatten(random_scene(random, 1 + random.below(60)), RenderSettings{}, 1);
        const Rays good = random_rays(random, arrays);
        Rays spoilt = good;
        std::vector<bool> is_bad(good.size());
        for (std::size_t i = 0; i < good.size(); ++i) {
            if (!(is_bad[i] = random.chance(n % 3 == 0 ? 0.5 : 0.05))) continue;
            const float what = random.chance(0.5) ? nan : random.chance(0.5) ? infinity : -infinity;
            const int axis = random.below(3), kind = random.below(5);
            if (kind == 0) spoilt.org[axis][i] = what;
            if (kind == 1) spoilt.dir[axis][i] = what;
            if (kind == 2)
                for (auto& component : spoilt.dir) component[i] = random.chance(0.5) ? 0.0f : -0.0f;
            if (kind == 3) spoilt.tmin[i] = nan;
            if (kind == 4) spoilt.tmax[i] = random.chance(0.5) ? nan : -infinity;
        }
        for (const KernelTable* kernels : balanced_kernels())
            for (const Query what : {Query::closest, Query::any})
                for (const bool brute_force : {false, true}) {
                    const Hits before = ask(*kernels, view(arrays), good, what, brute_force);
                    const Hits after = ask(*kernels, view(arrays), spoilt, what, brute_force);
                    for (std::size_t i = 0; i < good.size(); ++i) {
                        if (is_bad[i]) {
                            REQUIRE(after.slot[i] == -1);
                            continue;
                        }
                        // any_hit may name another hit when packets change
                        REQUIRE((after.slot[i] >= 0) == (before.slot[i] >= 0));
                        if (what == Query::any) continue;
                        REQUIRE(after.slot[i] == before.slot[i]);
                        REQUIRE(bits_of(after.t[i]) == bits_of(before.t[i]));
                    }
                }
    }
}

TEST_CASE("rays from beyond everything and with endless directions end, and change no other ray") {
    Random random(10);
    for (int n = 0; n < cases(100); ++n) {
        const SceneArrays arrays = flatten(random_scene(random, 1 + random.below(60)), RenderSettings{}, 1);
        const Rays good = random_rays(random, arrays);
        Rays far = good;
        std::vector<bool> is_far(good.size());
        for (std::size_t i = 0; i < good.size(); ++i) {
            if (!(is_far[i] = random.chance(n % 3 == 0 ? 1.0 : 0.2))) continue;
            const auto size = static_cast<float>(std::exp(random.uniform(std::log(1e30), std::log(3.4e38))));
            for (int axis = 0; axis < 3; ++axis) {
                const float end = random.chance(0.3) ? 0.0f : random.chance(0.5) ? size : -size;
                (n % 2 == 0 ? far.org : far.dir)[axis][i] = end;
            }
        }
        for (const KernelTable* kernels : usable_kernels())
            for (const Query what : {Query::closest, Query::any}) {
                const Hits before = ask(*kernels, view(arrays), good, what);
                const Hits after = ask(*kernels, view(arrays), far, what);
                for (std::size_t i = 0; i < good.size(); ++i) {
                    if (is_far[i]) {
                        const glm::dvec3 o = glm::abs(far.o(i)), d = glm::abs(far.d(i));
                        if (o.x + o.y + o.z + d.x + d.y + d.z > 1.01e34) REQUIRE(after.slot[i] == -1);
                        continue;
                    }
                    REQUIRE((after.slot[i] >= 0) == (before.slot[i] >= 0));
                    if (what == Query::any) continue; // any_hit may name another hit when packets change
                    REQUIRE(after.slot[i] == before.slot[i]);
                    REQUIRE(bits_of(after.t[i]) == bits_of(before.t[i]));
                }
            }
    }
}

TEST_CASE("a ray along a plane misses it, from either side and on it") {
    for (const double height : {-1.0, 0.0, 1.0})
        for (const double side : {-1.0, 1.0})
            for (int axis = 0; axis < 3; ++axis) {
                SceneDescription scene;
                glm::dvec3 normal(0);
                normal[axis] = side;
                scene.objects.push_back({Plane{normal * height, normal}, {}, {}, ""});
                scene.objects.push_back({Sphere{1, {0, 5, 0}}, {}, {}, ""});
                const SceneArrays arrays = flatten(scene, RenderSettings{}, 1);
                Rays rays;
                for (const double x : {-1.0, 0.0, 1.0})
                    for (const double y : {-1.0, 1.0}) {
                        glm::dvec3 d(x, y, x);
                        if (axis != 1) std::swap(d[1], d[axis]), d[axis] = 0;
                        d[axis] = 0;
                        if (d == glm::dvec3(0)) continue;
                        for (const double zero : {0.0, -0.0}) d[axis] = zero, rays.add({0, -4, 0}, d);
                    }
                for (const KernelTable* kernels : balanced_kernels()) {
                    const Hits hits = ask(*kernels, view(arrays), rays, Query::closest);
                    for (std::size_t i = 0; i < rays.size(); ++i) {
                        CHECK((hits.slot[i] < 0 || hits.t[i] < 1e30f));
                        if (hits.slot[i] >= 0) CHECK(static_cast<std::uint32_t>(hits.slot[i]) < arrays.first_slot[6]);
                    }
                }
            }
}

TEST_CASE("a ray's result does not depend on its batch: alone as in company") {
    Random random(7);
    for (int n = 0; n < cases(60); ++n) {
        const SceneArrays arrays = flatten(random_scene(random, 1 + random.below(60)), RenderSettings{}, 1);
        const Rays rays = random_rays(random, arrays);
        for (const KernelTable* kernels : balanced_kernels()) {
            const Hits together = ask(*kernels, view(arrays), rays, Query::closest);
            for (int k = 0; k < 20; ++k) {
                const auto i = static_cast<std::size_t>(random.below(static_cast<int>(rays.size())));
                Rays one;
                one.add(rays.o(i), rays.d(i));
                one.add_range(rays.tmin[i], rays.tmax[i]);
                const Hits alone = ask(*kernels, view(arrays), one, Query::closest);
                REQUIRE(alone.slot[0] == together.slot[i]);
                REQUIRE(bits_of(alone.t[0]) == bits_of(together.t[i]));
            }
        }
    }
}

TEST_CASE("float agrees with the reference in double") {
    Random random(8);
    std::uint64_t rays_total = 0, other = 0, off = 0;
    for (int n = 0; n < cases(100); ++n) {
        const SceneArrays arrays = flatten(random_scene(random, 1 + random.below(60)), RenderSettings{}, 1);
        Rays rays;
        for (int i = 0; i < 1000; ++i) rays.add(random.point(2), random.direction());
        const Hits truth = ask(reference_kernels(), view(arrays), rays, Query::closest);
        const Hits hits = ask(*balanced_kernels().back(), view(arrays), rays, Query::closest);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ++rays_total;
            if (hits.slot[i] != truth.slot[i])
                ++other; // silhouettes, and coincident surfaces
            else if (hits.slot[i] >= 0)
                off += std::fabs(hits.t[i] - truth.t[i]) > 1e-4f * truth.t[i] + 1e-6f; // grazing
        }
    }
    MESSAGE(rays_total, " rays: other primitive ", other, ", t off by more than 1e-4 ", off);
    CHECK(other < rays_total / 500);
    CHECK(off < rays_total / 500);
}
