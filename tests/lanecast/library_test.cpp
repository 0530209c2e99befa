// The public interface: what it answers.

#include "lanecast/library_support.hpp"
#include "render/dispatch.hpp"

#include <cstring>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

#ifdef LANECAST_SANITIZED
constexpr int rounds = 2;
#else
constexpr int rounds = 12;
#endif

std::vector<std::string> isas() {
    std::vector<std::string> names;
    for (const IsaInfo& isa : known_isas())
        if (isa.compiled && isa.supported) names.push_back(isa.name);
    return names;
}

std::vector<MeshArrays> arrays_of(const std::vector<TestMesh>& meshes) {
    std::vector<MeshArrays> arrays;
    for (const TestMesh& mesh : meshes) arrays.push_back(mesh.arrays());
    return arrays;
}

std::vector<TestMesh> random_meshes(Random& random, double size = 1, const glm::dvec3& centre = glm::dvec3(0)) {
    std::vector<TestMesh> meshes;
    for (int i = 1 + random.below(4); i > 0; --i)
        meshes.push_back(random_mesh(random, random.chance(0.1) ? 0 : random.below(120), size, centre));
    return meshes;
}

struct Nearest {
    double t = HUGE_VAL;
    std::uint32_t object = no_hit, triangle = no_hit;
    bool doubtful = false; ///< an edge, a grazing triangle or the end of the range is so close that rounding decides
};

Nearest brute_force(const std::vector<TestMesh>& meshes, const TestRays& rays, std::size_t i, double size) {
    Nearest nearest;
    const glm::dvec3 o = rays.origin(i), d = rays.direction(i);
    const double tmin = std::max(0.0f, rays.tmin[i]), tmax = rays.tmax[i], slack = 1e-5 * size / glm::length(d);
    for (std::uint32_t m = 0; m < meshes.size(); ++m)
        for (std::uint32_t k = 0; k < meshes[m].indices.size() / 3; ++k) {
            const glm::dvec3 a = meshes[m].vertex(k, 0), b = meshes[m].vertex(k, 1), c = meshes[m].vertex(k, 2);
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            if (glm::length(normal) == 0) continue;
            const glm::dvec3 unit = glm::normalize(normal);
            const double grazing = std::abs(glm::dot(unit, glm::normalize(d)));
            double margin = 0;
            const double t = truth(o, d, a, b, c, margin);
            const bool close_to_edge = std::abs(margin) < 1e-4 || grazing < 1e-2;
            const double at = glm::dot(a - o, unit) / glm::dot(d, unit); // where it would be hit
            if (margin > -1e-3 && (close_to_edge || std::abs(at - tmin) < 100 * slack || std::abs(at - tmax) < 100 * slack ||
                                   std::abs(at - nearest.t) < 100 * slack))
                nearest.doubtful = true;
            if (t > tmin && t <= tmax && t < nearest.t) {
                nearest.t = t;
                nearest.object = m;
                nearest.triangle = k;
            }
        }
    return nearest;
}

void check_hit(const std::vector<TestMesh>& meshes, const TestRays& rays, std::size_t i, const TestHits& hits, double size) {
    const TestMesh& mesh = meshes[hits.object[i]];
    const std::uint32_t k = hits.primitive[i];
    const glm::dvec3 a = mesh.vertex(k, 0), b = mesh.vertex(k, 1), c = mesh.vertex(k, 2);
    const double t = hits.t[i], u = hits.u[i], v = hits.v[i];
    const glm::dvec3 on_ray = rays.origin(i) + rays.direction(i) * t, on_triangle = a * (1 - u - v) + b * u + c * v;
    const glm::dvec3 normal(hits.nx[i], hits.ny[i], hits.nz[i]), truth = glm::normalize(glm::cross(b - a, c - a));
    CHECK(glm::distance(normal, truth) < 1e-4);
    CHECK(u >= 0);
    CHECK(v >= 0);
    CHECK(u + v <= 1.000001);
    CHECK(glm::distance(on_ray, on_triangle) < 2e-5 * size);
}

TEST_CASE("the nearest triangle, its distance in the caller's units, its normal and its weights") {
    Random random(20);
    int found = 0, doubtful = 0, all = 0;
    for (int round = 0; round < 4 * rounds; ++round) {
        const double size = std::exp2(random.uniform(-30, 30));
        const glm::dvec3 centre = random.point(random.chance(0.5) ? 0 : 20 * size);
        const std::vector<TestMesh> meshes = random_meshes(random, size, centre);
        const Scene scene(arrays_of(meshes), {.threads = 1, .isa = isas()[static_cast<std::size_t>(round) % isas().size()]});
        const TestRays rays = random_rays(random, 400, size, centre);
        TestHits hits(rays.size());
        std::vector<std::uint8_t> occluded(rays.size(), 9);
        scene.closest_hit(rays.arrays(), hits.arrays());
        scene.any_hit(rays.arrays(), occluded.data());
        const double reach = 2 * size + glm::length(centre) * 1e-1;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Nearest nearest = brute_force(meshes, rays, i, reach);
            const bool hit = hits.object[i] != no_hit;
            CHECK((occluded[i] == 1) == hit);
            CHECK((hits.primitive[i] == no_hit) == !hit);
            ++all;
            if (hit)
                check_hit(meshes, rays, i, hits, reach);
            else
                CHECK((hits.t[i] == rays.tmax[i] && hits.u[i] == 0 && hits.v[i] == 0 && hits.nx[i] == 0 && hits.ny[i] == 0 &&
                       hits.nz[i] == 0));
            if (nearest.doubtful) {
                ++doubtful;
                continue;
            }
            found += hit;
            CHECK(hits.object[i] == nearest.object);
            CHECK(hits.primitive[i] == nearest.triangle);
            if (hit) CHECK(hits.t[i] == doctest::Approx(nearest.t).epsilon(1e-4));
        }
        CHECK(hits.guards_untouched());
    }
    CHECK(found > all / 10);
    CHECK(doubtful < all / 2);
}

TEST_CASE("every length, from any place: the same bits as one by one") {
    Random random(21);
    const std::vector<TestMesh> meshes{random_mesh(random, 90, 3, {5, 5, 5}), random_mesh(random, 90, 3, {5, 5, 5})};
    const TestRays rays = random_rays(random, 1110, 3, {5, 5, 5});
    for (const std::string& isa : isas()) {
        const Scene scene(arrays_of(meshes), {.threads = 1, .isa = isa});
        TestHits alone(rays.size());
        std::vector<std::uint8_t> alone_occluded(rays.size(), 9);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            scene.closest_hit(rays.arrays(i, 1), alone.arrays(i));
            scene.any_hit(rays.arrays(i, 1), &alone_occluded[i]);
        }
        std::size_t different = 0;
        for (std::size_t n = 0; n <= 1100; n += rounds > 2 ? 1 : 53) {
            const std::size_t begin = n % 10;
            TestHits hits(n);
            std::vector<std::uint8_t> occluded(n + 1, 9);
            scene.closest_hit(rays.arrays(begin, n), hits.arrays());
            scene.any_hit(rays.arrays(begin, n), occluded.data());
            for (std::size_t i = 0; i < n; ++i) {
                different += hits.same(i, alone, begin + i) ? 0 : 1;
                different += occluded[i] == alone_occluded[begin + i] ? 0 : 1;
            }
            different += hits.guards_untouched() && occluded[n] == 9 ? 0 : 1;
        }
        CAPTURE(isa);
        CHECK(different == 0);
    }
}

TEST_CASE("balanced has the same bits on every instruction set") {
    Random random(22);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<TestMesh> meshes = random_meshes(random, 2, random.point(9));
        const TestRays rays = random_rays(random, 3000, 2);
        TestHits first(rays.size());
        for (const std::string& isa : isas()) {
            TestHits hits(rays.size());
            Scene(arrays_of(meshes), {.isa = isa}).closest_hit(rays.arrays(), hits.arrays());
            if (isa == isas().front()) {
                first = hits;
                continue;
            }
            std::size_t different = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) different += hits.same(i, first, i) ? 0 : 1;
            CHECK(different == 0);
        }
    }
}

TEST_CASE("the tree decides the time only") {
    Random random(27);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<TestMesh> meshes{random_mesh(random, 600, 2), random_mesh(random, 600, 2)};
        const TestRays rays = random_rays(random, 2000, 2);
        TestHits plain(rays.size()), quality(rays.size());
        Scene(arrays_of(meshes)).closest_hit(rays.arrays(), plain.arrays());
        const Scene scene(arrays_of(meshes), {.bvh = "quality"});
        scene.closest_hit(rays.arrays(), quality.arrays());
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) different += quality.same(i, plain, i) ? 0 : 1;
        CHECK(different == 0);
    }
}

TEST_CASE("the unit of length may be any power of two") {
    Random random(23);
    const TestMesh mesh = random_mesh(random, 200, 1, {0.25, -3, 7});
    const TestRays rays = random_rays(random, 2000, 1, {0.25, -3, 7});
    TestHits hits(rays.size());
    Scene(mesh.arrays()).closest_hit(rays.arrays(), hits.arrays());
    for (const int k : {-60, -20, -1, 3, 40, 90}) {
        TestMesh scaled = mesh;
        for (std::size_t i = 0; i < scaled.positions.size(); ++i)
            if (i % scaled.floats < 3) scaled.positions[i] = std::ldexp(scaled.positions[i], k);
        TestRays scaled_rays = rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            for (Floats& axis : scaled_rays.org) axis[i] = std::ldexp(axis[i], k);
            scaled_rays.tmin[i] = std::ldexp(rays.tmin[i], k);
            scaled_rays.tmax[i] = std::ldexp(rays.tmax[i], k);
        }
        TestHits scaled_hits(rays.size());
        Scene(scaled.arrays()).closest_hit(scaled_rays.arrays(), scaled_hits.arrays());
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            hits.t[i] = std::ldexp(hits.t[i], k);
            different += hits.same(i, scaled_hits, i) ? 0 : 1;
            hits.t[i] = std::ldexp(hits.t[i], -k);
        }
        CAPTURE(k);
        CHECK(different == 0);
    }
}

TEST_CASE("hints change nothing but the time, t may be tmax, and nothing asked for is left out alone") {
    Random random(24);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<TestMesh> meshes = random_meshes(random, 1, random.point(4));
        const Scene scene(arrays_of(meshes));
        TestRays rays = random_rays(random, 1 + static_cast<std::size_t>(random.below(2500)));
        const bool common = round % 2 == 0;
        for (std::size_t i = 0; common && i < rays.size(); ++i) rays.set(i, rays.origin(0), rays.direction(i));
        TestHits plain(rays.size());
        scene.closest_hit(rays.arrays(), plain.arrays());
        for (const Coherence coherence : {Coherence::coherent, Coherence::incoherent}) {
            RayArrays hinted = rays.arrays();
            hinted.coherence = coherence;
            hinted.common_origin = common;
            const float eye[3] = {rays.org[0][0], rays.org[1][0], rays.org[2][0]};
            if (common) hinted.org_x = eye, hinted.org_y = eye + 1, hinted.org_z = eye + 2;
            TestHits hits(rays.size());
            scene.closest_hit(hinted, hits.arrays());
            std::size_t different = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) different += hits.same(i, plain, i) ? 0 : 1;
            CHECK(different == 0);
        }
        HitArrays only;
        Floats in_place = rays.tmax;
        RayArrays own = rays.arrays();
        own.tmax = only.t = in_place.data();
        scene.closest_hit(own, only);
        TestHits parts(rays.size());
        only = {};
        only.primitive = parts.primitive.data();
        scene.closest_hit(rays.arrays(), only);
        only = {};
        only.object = parts.object.data();
        only.u = parts.u.data();
        only.v = parts.v.data();
        scene.closest_hit(rays.arrays(), only);
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            different += in_place[i] == plain.t[i] && parts.primitive[i] == plain.primitive[i] &&
                                 parts.object[i] == plain.object[i] && parts.u[i] == plain.u[i] && parts.v[i] == plain.v[i]
                             ? 0
                             : 1;
        CHECK(different == 0);
        CHECK(in_place.guards_untouched());
    }
}

TEST_CASE("rays that are none hit nothing and disturb no neighbour") {
    Random random(25);
    const TestMesh mesh = random_mesh(random, 300);
    for (const std::string& isa : isas()) {
        const Scene scene(mesh.arrays(), {.isa = isa});
        TestRays rays = random_rays(random, 2000);
        TestHits before(rays.size()), after(rays.size());
        scene.closest_hit(rays.arrays(), before.arrays());
        std::vector<bool> spoilt(rays.size(), false);
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (std::size_t i = 0; i < rays.size(); i += 1 + static_cast<std::size_t>(random.below(5))) {
            spoilt[i] = true;
            const float bad = random.chance(0.4) ? nan : random.chance(0.5) ? infinity : -infinity;
            const auto axis = static_cast<std::size_t>(random.below(3));
            switch (random.below(5)) {
            case 0:
                rays.org[axis][i] = bad;
                break;
            case 1:
                rays.dir[axis][i] = bad;
                break;
            case 2:
                rays.set(i, rays.origin(i), {0, -0.0, 0});
                break;
            case 3:
                rays.tmin[i] = random.chance(0.5) ? nan : infinity;
                break;
            default:
                rays.tmax[i] = random.chance(0.5) ? nan : -1;
            }
        }
        std::vector<std::uint8_t> occluded(rays.size(), 9);
        scene.closest_hit(rays.arrays(), after.arrays());
        scene.any_hit(rays.arrays(), occluded.data());
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (spoilt[i])
                wrong += after.object[i] == no_hit && occluded[i] == 0 ? 0 : 1;
            else
                wrong += after.same(i, before, i) ? 0 : 1;
        }
        CAPTURE(isa);
        CHECK(wrong == 0);
    }
}

TEST_CASE("shadows of coherent rays do not depend on what hid the light before") {
    Random random(27);
    for (int round = 0; round < rounds; ++round) {
        // a roof of few large triangles with holes, leaves of all sizes under it, and a floor of rays to a lamp or the sun
        TestMesh mesh = random_mesh(random, 200, 0.6);
        for (int i = 0; i < 6; ++i)
            for (int corner = 0; corner < 3; ++corner) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size() / mesh.floats));
                for (std::size_t k = 0; k < mesh.floats; ++k)
                    mesh.positions.push_back(k == 1 ? 1.5f : static_cast<float>(random.uniform(-2, 2)));
            }
        const bool lamp = round % 2 == 0;
        const glm::dvec3 light = glm::dvec3(random.uniform(-1, 1), 3, random.uniform(-1, 1));
        TestRays rays(8192);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec3 from(static_cast<double>(i % 128) / 32 - 2, -1, static_cast<double>(i / 128) / 16 - 2);
            rays.set(i, from, lamp ? light - from : light);
            if (lamp) rays.tmax[i] = 1;
        }
        for (const std::string& isa : isas()) {
            const Scene scene(mesh.arrays(), {.threads = 1, .isa = isa});
            TestHits hits(rays.size());
            std::vector<std::uint8_t> occluded(rays.size(), 9);
            scene.closest_hit(rays.arrays(), hits.arrays());
            scene.any_hit(rays.arrays(), occluded.data());
            std::size_t wrong = 0, dark = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                wrong += (occluded[i] == 1) == (hits.object[i] != no_hit) ? 0 : 1;
                dark += occluded[i];
            }
            CAPTURE(isa);
            CHECK(wrong == 0);
            CHECK(dark > rays.size() / 8);
            CHECK(dark < rays.size());
        }
    }
}

TEST_CASE("a thread's answers do not depend on the scenes and lights that it asked about before") {
    // Roofs at one place in the tree and another, so that what hid the light in one scene is something else in the next, or
    // nothing; scenes come and go at the same addresses, and calls are short enough to begin with what the last one left.
    Random random(28);
    for (int round = 0; round < rounds; ++round) {
        std::unique_ptr<Scene> scene;
        glm::dvec2 roof_lo(0), roof_hi(0);
        for (int call = 0; call < 24; ++call) {
            if (call % 3 == 0) {
                TestMesh mesh = random_mesh(random, random.below(2000), 0.4, {0, -3, 0});
                roof_lo = {random.uniform(-2, 0), random.uniform(-2, 0)};
                roof_hi = {random.uniform(0.5, 2), random.uniform(0.5, 2)};
                for (const glm::dvec2& p :
                     {roof_lo, glm::dvec2(roof_hi.x, roof_lo.y), roof_hi, roof_lo, roof_hi, glm::dvec2(roof_lo.x, roof_hi.y)}) {
                    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size() / mesh.floats));
                    for (const double coordinate : {p.x, 1.0, p.y}) mesh.positions.push_back(static_cast<float>(coordinate));
                    mesh.positions.resize(mesh.positions.size() + mesh.floats - 3);
                }
                scene.reset();
                scene = std::make_unique<Scene>(mesh.arrays(), BuildOptions{.threads = 1});
            }
            TestRays rays(static_cast<std::size_t>(64 + random.below(1000)));
            const glm::dvec3 light(random.uniform(-0.5, 0.5), 1, random.uniform(-0.5, 0.5));
            for (std::size_t i = 0; i < rays.size(); ++i)
                rays.set(i, {random.uniform(-2, 2), random.chance(0.1) ? 2 : -1, random.uniform(-2, 2)}, light);
            std::vector<std::uint8_t> occluded(rays.size(), 9);
            scene->any_hit(rays.arrays(), occluded.data());
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const glm::dvec3 at = rays.origin(i) + 2.0 * light; // where the ray meets the roof's plane
                const double inside = std::min({at.x - roof_lo.x, roof_hi.x - at.x, at.z - roof_lo.y, roof_hi.y - at.z});
                const bool hidden = rays.origin(i).y < 1 && inside > 0;
                wrong += std::abs(inside) < 1e-5 || (occluded[i] == 1) == hidden ? 0 : 1;
            }
            CAPTURE(call);
            REQUIRE(wrong == 0);
        }
    }
}

TEST_CASE("callers at the same time") {
    Random random(26);
    const TestMesh mesh = random_mesh(random, 500);
    const Scene scene(mesh.arrays());
    const TestRays rays = random_rays(random, 4000);
    TestHits expected(rays.size());
    scene.closest_hit(rays.arrays(), expected.arrays());
    std::vector<std::size_t> different(4, 0);
    {
        std::vector<std::jthread> callers;
        for (std::size_t caller = 0; caller < different.size(); ++caller)
            callers.emplace_back([&, caller] {
                for (int repeat = 0; repeat < rounds; ++repeat) {
                    TestHits hits(rays.size());
                    std::vector<std::uint8_t> occluded(rays.size(), 9);
                    scene.closest_hit(rays.arrays(), hits.arrays());
                    scene.any_hit(rays.arrays(), occluded.data());
                    for (std::size_t i = 0; i < rays.size(); ++i)
                        different[caller] +=
                            hits.same(i, expected, i) && (occluded[i] == 1) == (expected.object[i] != no_hit) ? 0 : 1;
                }
            });
    }
    for (const std::size_t count : different) CHECK(count == 0);
}

} // namespace
