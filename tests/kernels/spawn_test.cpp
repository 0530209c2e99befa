// Rays that start on surfaces: no surface shadows itself, no ray inside a body escapes through it, and what is close is seen
// (numerics N8, N9).

#include "kernels/kernel_support.hpp"
#include "kernels/traced_batch.hpp"
#include "render/kernels/surface.hpp"
#include "scene/flatten.hpp"
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr std::uint32_t W = width<F>;
using Batch = TracedBatch<F>;

glm::dvec3 direction(Lottery& random) {
    const auto d = random.direction();
    return {d[0], d[1], d[2]};
}

struct Spawned {
    std::uint64_t outside = 0, self_shadowed = 0; ///< rays from the outside of a convex body
    std::uint64_t inside = 0, escaped = 0;        ///< rays within it
    std::uint64_t wrong_side = 0;                 ///< of a closed body
    double largest_offset = 0;
};

/// Hits of object 0, and rays on from them: half of them grazing.
Spawned spawn(const SceneDescription& description, int rays, std::uint64_t seed) {
    Lottery random(seed);
    const FlushDenormals flush;
    const SceneArrays arrays = flatten(description, RenderSettings{}, 1);
    const SceneView scene = view(arrays);
    const auto scratch = std::make_unique<TraceScratch<F>>();
    Spawned result;
    // where object 0 is, in normalised lengths
    glm::dvec3 centre(0);
    double size = 1;
    for (std::uint32_t slot = 0; slot < scene.first_slot[6]; ++slot) {
        if (scene.object[slot] != 0) continue;
        if (slot >= scene.first_slot[2]) {
            const AffineRecord& r = scene.affines[slot - scene.first_slot[2]];
            centre = {r.translation[0], r.translation[1], r.translation[2]};
            double largest = 0;
            for (const float m : scene.affine_shading[slot - scene.first_slot[2]].world_from_object)
                largest = std::fmax(largest, static_cast<double>(std::fabs(m)));
            size = largest;
        } else if (slot >= scene.first_slot[1]) {
            const SphereRecord& r = scene.spheres[slot - scene.first_slot[1]];
            centre = {r.centre[0], r.centre[1], r.centre[2]}, size = static_cast<double>(r.radius);
        }
    }
    if (const auto* mesh = std::get_if<Mesh>(&description.objects[0].shape)) {
        glm::dvec3 lo(1e300), hi(-1e300);
        for (const glm::dvec3& p : mesh->positions) lo = glm::min(lo, p), hi = glm::max(hi, p);
        centre = ((lo + hi) * 0.5 - arrays.normalisation.centre) * arrays.normalisation.scale;
        size = 0.5 * glm::length(hi - lo) * arrays.normalisation.scale;
    }
    for (int n = 0; n < rays; n += static_cast<int>(batch)) {
        Batch first, next;
        const bool from_within = n % (2 * static_cast<int>(batch)) != 0;
        for (std::uint32_t i = 0; i < batch; ++i) {
            const glm::dvec3 o =
                centre + direction(random) * size * (from_within ? random.uniform(0, 0.05) : random.uniform(2, 6));
            first.set(i, o,
                      from_within ? direction(random)
                                  : (centre + direction(random) * (0.4 * size) - o) * random.magnitude(0.01, 100));
        }
        first.trace_in<Query::closest>(scene, *scratch);
        std::vector<bool> is_used(batch), is_inside(batch);
        for (std::uint32_t i = 0; i < batch; i += W) {
            const Int<F> slot = load_int<F>(first.rays.slot + i);
            const Mask<F> found = slot > Int<F>(-1);
            if (none(found)) continue;
            const Surface<F> s = surface_at<F>(scene, load<F>(first.rays.org, i), load<F>(first.rays.dir, i),
                                               load<F>(first.rays.t + i), slot, found);
            const Vec3<F> start = s.point + s.normal * s.offset;
            alignas(64) S p[3][W], normal[3][W], offset[W];
            S* const p_rows[3] = {p[0], p[1], p[2]};
            S* const n_rows[3] = {normal[0], normal[1], normal[2]};
            store<F>(p_rows, 0, start);
            store<F>(n_rows, 0, s.normal);
            lanecast::store(offset, s.offset);
            for (std::uint32_t lane = 0; lane < W; ++lane) {
                const std::int32_t hit = first.slot[i + lane];
                if (hit < 0 || scene.object[hit] != 0) continue;
                is_used[i + lane] = true;
                is_inside[i + lane] = (bits(s.inside) >> lane & 1u) != 0;
                const glm::dvec3 up(normal[0][lane], normal[1][lane], normal[2][lane]);
                const glm::dvec3 side = glm::normalize(glm::cross(up, direction(random)));
                const double cosine = random.chance(0.5) ? random.uniform(0.01, 1) : random.magnitude(1e-4, 1e-1);
                const glm::dvec3 d = up * cosine + side * std::sqrt(1 - cosine * cosine);
                for (int axis = 0; axis < 3; ++axis) {
                    next.rays.org[axis][i + lane] = p[axis][lane];
                    next.rays.dir[axis][i + lane] = static_cast<S>(d[axis]);
                }
                const bool quadric =
                    hit >= static_cast<std::int32_t>(scene.first_slot[1]) && hit < static_cast<std::int32_t>(scene.first_slot[6]);
                next.source[i + lane] = is_inside[i + lane] && quadric ? source_inward(hit) : source_outward(hit);
                result.largest_offset = std::fmax(result.largest_offset, static_cast<double>(offset[lane]) / size);
            }
        }
        for (std::uint32_t i = 0; i < batch; ++i)
            if (!is_used[i]) next.set(i, {9, 9, 9}, {1, 1, 1});
        next.trace_in<Query::closest>(scene, *scratch);
        for (std::uint32_t i = 0; i < batch; ++i) {
            if (!is_used[i]) continue;
            const bool meets = next.slot[i] >= 0 && scene.object[next.slot[i]] == 0;
            result.wrong_side += is_inside[i] != from_within;
            if (from_within)
                ++result.inside, result.escaped += !meets;
            else
                ++result.outside, result.self_shadowed += meets;
        }
    }
    return result;
}

Object body(int kind) {
    Object object;
    switch (kind) {
    case 0:
        object.shape = Sphere{};
        break;
    case 1:
        object.shape = Sphere{};
        object.transformations = {Scale{{0.4, 1, 0.7}}, Rotation{{1, 2, 3}, 33}};
        break;
    case 2:
        object.shape = Cylinder{0.8, 1.1};
        object.transformations = {Rotation{{1, -2, 0.5}, 71}};
        break;
    case 4:
        object.shape = Cone{1, 0.2, 1.1};
        object.transformations = {Rotation{{1, -2, 0.5}, 71}};
        break;
    default: { // a convex mesh: an ellipsoid's, so that no two faces are parallel
        Mesh mesh;
        const int n = 24, m = 48;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j < m; ++j) {
                const double a = 3.14159265358979 * i / n, b = 6.28318530717959 * j / m;
                mesh.positions.emplace_back(std::sin(a) * std::cos(b), 0.8 * std::cos(a), 0.9 * std::sin(a) * std::sin(b));
            }
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < m; ++j) {
                const auto at = [&](int r, int c) {
                    return static_cast<std::uint32_t>(r == 0 ? 0 : r == n ? n * m : r * m + c % m);
                };
                if (i > 0) mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
                if (i + 1 < n) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
            }
        object.shape = mesh;
    }
    }
    return object;
}
constexpr const char* body_names[] = {"sphere", "ellipsoid", "cylinder", "convex mesh", "cone"};

/// Object 0 of that size at that distance from a marker, in units of its size.
SceneDescription scene_of(int kind, double size, double offset) {
    SceneDescription scene;
    Object object = body(kind);
    const glm::dvec3 away = glm::dvec3(0.7, -0.5, 0.6) * offset * size;
    if (auto* mesh = std::get_if<Mesh>(&object.shape)) {
        for (glm::dvec3& p : mesh->positions) p = p * size + away;
    } else {
        object.transformations.emplace_back(Scale{glm::dvec3(size)});
        object.transformations.emplace_back(Translation{away});
    }
    scene.objects.push_back(object);
    if (offset > 0) scene.objects.push_back({Sphere{1e-3 * size, -away}, {}, {}, "marker"});
    return scene;
}

} // namespace

TEST_CASE("no surface shadows itself, no ray escapes from inside a body: scales 1e-4 to 1e7, offsets to 1e3") {
    for (int kind = 0; kind < 5; ++kind) {
        for (const double size : {1e-4, 1.0, 1e4, 1e7}) {
            INFO(std::string(body_names[kind]), " of size ", size);
            const Spawned s = spawn(scene_of(kind, size, 0), cases(120000), 1);
            CHECK(s.self_shadowed == 0);
            // a chord shorter than the error of its ends may be lost
            CHECK(s.escaped <= (kind == 3 ? s.inside / 10000 : 0));
            CHECK(s.outside > 1000u / fewer);
            CHECK(s.inside > 1000u / fewer);
            CHECK(s.wrong_side == 0);
            CHECK(s.largest_offset < 1e-5);
        }
        for (const double offset : {10.0, 1e3}) {
            INFO(std::string(body_names[kind]), " at ", offset, " times its size");
            const Spawned s = spawn(scene_of(kind, 1, offset), cases(120000), 2);
            // vertices on float's grid make no body that is convex to a double's offset
            if (kind != 3 || sizeof(S) == 4) CHECK(s.self_shadowed == 0);
            CHECK(s.outside > 1000u / fewer);
        }
    }
}

TEST_CASE("a ray from outside a body enters it where it grazes it") {
    for (const int kind : {0, 1, 2, 4}) {
        CAPTURE(std::string(body_names[kind]));
        Lottery random(10);
        const FlushDenormals flush;
        const SceneArrays arrays = flatten(scene_of(kind, 1, 0), RenderSettings{}, 1);
        const SceneView scene = view(arrays);
        const double size = arrays.normalisation.scale;
        const auto scratch = std::make_unique<TraceScratch<F>>();
        Batch at, along;
        std::uint64_t hits = 0, inside = 0;
        for (int n = 0; n < cases(500000); n += static_cast<int>(batch)) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                const glm::dvec3 o = direction(random) * (4 * size);
                at.set(i, o, direction(random) * (0.5 * size) - o);
            }
            at.trace_in<Query::closest>(scene, *scratch);
            for (std::uint32_t i = 0; i < batch; i += W) {
                const Int<F> slot = load_int<F>(at.rays.slot + i);
                const Mask<F> found = slot > Int<F>(-1);
                if (none(found)) continue;
                const Surface<F> s =
                    surface_at<F>(scene, load<F>(at.rays.org, i), load<F>(at.rays.dir, i), load<F>(at.rays.t + i), slot, found);
                alignas(64) S p[3][W], normal[3][W];
                S* const p_rows[3] = {p[0], p[1], p[2]};
                S* const n_rows[3] = {normal[0], normal[1], normal[2]};
                store<F>(p_rows, 0, s.point);
                store<F>(n_rows, 0, s.normal);
                for (std::uint32_t lane = 0; lane < W; ++lane) {
                    const glm::dvec3 up(normal[0][lane], normal[1][lane], normal[2][lane]),
                        point(p[0][lane], p[1][lane], p[2][lane]);
                    const bool met = (bits(found) >> lane & 1u) != 0;
                    const glm::dvec3 side = met ? glm::normalize(glm::cross(up, direction(random))) : direction(random);
                    const double off = size * random.uniform(-1, 1) * random.magnitude(1e-8, 1e-5);
                    along.set(i + lane,
                              met ? point + up * off - side * (size * random.magnitude(3, 100)) : direction(random) * (9 * size),
                              side);
                }
            }
            along.trace_in<Query::closest>(scene, *scratch);
            for (std::uint32_t i = 0; i < batch; i += W) {
                const Int<F> slot = load_int<F>(along.rays.slot + i);
                const Mask<F> found = slot > Int<F>(-1);
                if (none(found)) continue;
                const Surface<F> s = surface_at<F>(scene, load<F>(along.rays.org, i), load<F>(along.rays.dir, i),
                                                   load<F>(along.rays.t + i), slot, found);
                hits += static_cast<std::uint64_t>(std::popcount(bits(found)));
                inside += static_cast<std::uint64_t>(std::popcount(bits(s.inside)));
            }
        }
        CHECK(inside == 0);
        CHECK(hits > 1000u / fewer);
    }
}

TEST_CASE("a plane does not shadow itself") {
    Lottery random(3);
    for (int n = 0; n < cases(60); ++n) {
        SceneDescription scene;
        scene.objects.push_back({Sphere{1, {0, 0, 0}}, {}, {}, "gives the scale"});
        scene.objects.push_back({Plane{direction(random) * random.magnitude(0.01, 1e4), direction(random)}, {}, {}, ""});
        std::swap(scene.objects[0], scene.objects[1]);
        const Spawned s = spawn(scene, 4096, 4);
        CHECK(s.self_shadowed == 0);
    }
}

TEST_CASE("what lies four offsets above a surface is seen by every ray from it") {
    if constexpr (sizeof(S) == 8) return; // its offsets are finer than the grid of the vertices
    Lottery random(5);
    const FlushDenormals flush;
    std::uint64_t rays = 0, lost = 0;
    double widest = 0;
    for (int n = 0; n < cases(60); ++n) {
        const std::vector<Transformation> turn{Rotation{direction(random), random.uniform(0, 360)},
                                               Translation{direction(random)}};
        const auto sheet = [&](double y, double half) {
            Mesh mesh;
            mesh.positions = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}};
            mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
            return Object{mesh, turn, {}, ""};
        };
        double gap = 0;
        for (const bool measure : {true, false}) {
            SceneDescription description;
            description.objects = {sheet(0, 1), sheet(measure ? 0.5 : gap, 1)};
            const SceneArrays arrays = flatten(description, RenderSettings{}, 1);
            const SceneView scene = view(arrays);
            const double unit = arrays.normalisation.scale;
            const auto scratch = std::make_unique<TraceScratch<F>>();
            Batch down, up;
            const AffineTransform world = compose(turn);
            const auto place = [&](const glm::dvec3& p) { return (apply(world, p) - arrays.normalisation.centre) * unit; };
            for (std::uint32_t i = 0; i < batch; ++i) { // from below, so that the floor is met first
                const glm::dvec3 q(random.uniform(-0.4, 0.4), 0, random.uniform(-0.4, 0.4));
                down.set(i, place(q - glm::dvec3(0, 1, 0)), place(q) - place(q - glm::dvec3(0, 1, 0)));
            }
            down.trace_in<Query::closest>(scene, *scratch);
            std::uint32_t used = 0;
            for (std::uint32_t i = 0; i < batch; i += W) {
                const Int<F> slot = load_int<F>(down.rays.slot + i);
                const Mask<F> found = slot > Int<F>(-1);
                REQUIRE(all(found));
                const Surface<F> s = surface_at<F>(scene, load<F>(down.rays.org, i), load<F>(down.rays.dir, i),
                                                   load<F>(down.rays.t + i), slot, found);
                // as a ray that is transmitted straight on
                const Vec3<F> start = s.point - s.normal * s.offset;
                alignas(64) S offset[W];
                lanecast::store(offset, s.offset);
                store<F>(up.rays.org, i, start);
                for (std::uint32_t lane = 0; lane < W; ++lane, ++used) {
                    if (measure) gap = std::fmax(gap, 4 * static_cast<double>(offset[lane]) / unit);
                    const glm::dvec3 d(random.uniform(-1, 1), random.uniform(0.2, 1), random.uniform(-1, 1));
                    const glm::dvec3 d_world = world.linear * d;
                    for (int axis = 0; axis < 3; ++axis) up.rays.dir[axis][i + lane] = static_cast<S>(d_world[axis]);
                    up.source[i + lane] = source_outward(down.slot[i + lane]);
                }
            }
            if (measure) continue;
            widest = std::fmax(widest, gap);
            up.trace_in<Query::any>(scene, *scratch);
            for (std::uint32_t i = 0; i < used; ++i) ++rays, lost += up.slot[i] < 0;
        }
    }
    MESSAGE("gaps up to ", widest, " of a sheet of size 2");
    CHECK(lost == 0);
    CHECK(rays > 0);
    CHECK(widest < 2e-5);
}

TEST_CASE("a triangle in several leaves is hit by its own rays in none of them") {
    Lottery random(7);
    const FlushDenormals flush;
    std::uint64_t own = 0, of_parts = 0;
    for (int n = 0; n < cases(20); ++n) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < 300; ++i) { // a few across many small ones
            const double length = i % 10 == 0 ? 2 : 0.1;
            const glm::dvec3 p = direction(random) * (i % 10 == 0 ? 1.0 : random.uniform(0, 1));
            mesh.positions.insert(mesh.positions.end(), {p, p + direction(random) * length, p + direction(random) * length});
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        SceneDescription description;
        description.objects.push_back({mesh, {}, {}, ""});
        RenderSettings settings;
        settings.bvh = BvhMode::quality;
        const SceneArrays arrays = flatten(description, settings, 1);
        const SceneView scene = view(arrays);
        std::vector<int> parts(arrays.triangles.size(), 1);
        for (const std::uint32_t slot : arrays.shared_slots) ++parts[slot];
        const auto scratch = std::make_unique<TraceScratch<F>>();
        for (int k = 0; k < 8; ++k) { // packets, and rays that go alone
            Batch rays;
            const glm::dvec3 eye = direction(random) * 3.0, spread = glm::dvec3(k < 4 ? 0.1 : 2.0);
            for (std::uint32_t i = 0; i < batch; ++i)
                rays.set(i, eye + direction(random) * spread, direction(random) * 0.5 - eye);
            rays.trace_in<Query::closest>(scene, *scratch);
            const std::vector<std::int32_t> first = rays.slot;
            for (std::uint32_t i = 0; i < batch; ++i) rays.source[i] = first[i] < 0 ? no_source : source_outward(first[i]);
            rays.trace_in<Query::closest>(scene, *scratch);
            for (std::uint32_t i = 0; i < batch; ++i) {
                if (first[i] < 0) continue;
                own += rays.slot[i] == first[i];
                of_parts += parts[static_cast<std::size_t>(first[i])] > 1;
            }
        }
    }
    CHECK(own == 0);
    CHECK(of_parts > 100);
}

TEST_CASE("a disc far thinner than it is far away: the cap on the ray's side is met") {
    const FlushDenormals flush;
    for (const double thickness : {1e-2, 1e-5, 1e-8}) {
        SceneDescription description;
        description.objects.push_back({Cylinder{1, thickness}, {}, {}, ""});
        const SceneArrays arrays = flatten(description, RenderSettings{}, 1);
        const SceneView scene = view(arrays);
        const auto scratch = std::make_unique<TraceScratch<F>>();
        Lottery random(6);
        std::uint64_t wrong = 0, hits = 0;
        for (int n = 0; n < cases(100); ++n) {
            Batch rays;
            for (std::uint32_t i = 0; i < batch; ++i) {
                glm::dvec3 o = direction(random) * 20.0;
                if (std::fabs(o.y) < 5) o.y = o.y < 0 ? o.y - 5 : o.y + 5;
                rays.set(i, o, glm::dvec3(random.uniform(-0.6, 0.6), 0, random.uniform(-0.6, 0.6)) - o);
            }
            rays.trace_in<Query::closest>(scene, *scratch);
            for (std::uint32_t i = 0; i < batch; i += W) {
                const Int<F> slot = load_int<F>(rays.rays.slot + i);
                const Mask<F> found = slot > Int<F>(-1);
                hits += static_cast<std::uint64_t>(std::popcount(bits(found)));
                if (none(found)) continue;
                const Surface<F> s = surface_at<F>(scene, load<F>(rays.rays.org, i), load<F>(rays.rays.dir, i),
                                                   load<F>(rays.rays.t + i), slot, found);
                wrong += static_cast<std::uint64_t>(std::popcount(bits(s.inside & found)));
            }
        }
        CAPTURE(thickness);
        CHECK(hits == static_cast<std::uint64_t>(cases(100)) * batch);
        CHECK(wrong == 0);
    }
}
