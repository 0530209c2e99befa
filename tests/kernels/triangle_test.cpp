// The triangle test: watertight on edge- and vertex-aimed rays, accurate t, quiet on degenerate input (numerics N1, N12).

#include "kernels/kernel_support.hpp"
#include "render/kernels/packet.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace lanecast;
using namespace lanecast::test;

namespace {

using F = NativeFloat;
using S = Scalar<F>;
constexpr int W = width<F>;
constexpr double ulp_of_s = sizeof(S) == 4 ? 1 : 0x1p-29;

using Point = std::array<float, 3>;
struct ClosedMesh {
    std::vector<Point> vertices;
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::vector<int>> of_vertex; ///< triangles around each vertex
};

void finish(ClosedMesh& mesh) {
    mesh.of_vertex.resize(mesh.vertices.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const int v : mesh.triangles[t]) mesh.of_vertex[static_cast<std::size_t>(v)].push_back(static_cast<int>(t));
}

/// A sphere of n x 2n quads; `bump` displaces it, `place` stretches and moves it.
template <class Place>
ClosedMesh sphere_mesh(int n, double bump, Place&& place) {
    ClosedMesh mesh;
    const int m = 2 * n;
    const auto add = [&](double x, double y, double z) {
        const std::array<double, 3> p = place(x, y, z);
        mesh.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    };
    add(0, 1, 0);
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double a = 3.14159265358979 * i / n, b = 2 * 3.14159265358979 * j / m;
            const double r = 1 + bump * std::sin(7 * a) * std::cos(5 * b);
            add(r * std::sin(a) * std::cos(b), r * std::cos(a), r * std::sin(a) * std::sin(b));
        }
    add(0, -1, 0);
    const int last = static_cast<int>(mesh.vertices.size()) - 1;
    const auto at = [&](int i, int j) { return i == 0 ? 0 : i == n ? last : 1 + (i - 1) * m + j % m; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            if (i > 0) mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            if (i + 1 < n) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    finish(mesh);
    return mesh;
}

/// Rays of one dominant axis against one triangle, as the traversal calls it.
ShearedRay<F> shear(const Axes& axes, const S (*org)[W], const S (*dir)[W]) {
    const F dz = load<F>(dir[axes.kz]);
    return {{load<F>(org[axes.kx]), load<F>(org[axes.ky]), load<F>(org[axes.kz])},
            {load<F>(dir[axes.kx]) / dz, load<F>(dir[axes.ky]) / dz, F(1) / dz}};
}
Vec3<F> vertex(const Axes& axes, const Point& p) {
    return {F(S(p[static_cast<std::size_t>(axes.kx)])), F(S(p[static_cast<std::size_t>(axes.ky)])),
            F(S(p[static_cast<std::size_t>(axes.kz)]))};
}
int dominant(const S (*dir)[W], int lane) {
    const S x = std::fabs(dir[0][lane]), y = std::fabs(dir[1][lane]), z = std::fabs(dir[2][lane]);
    return z > std::max(x, y) ? 2 : y > x ? 1 : 0;
}

bool hits_any(const ClosedMesh& mesh, const S (*org)[W], const S (*dir)[W], int lane) {
    const Axes axes = axes_of(dominant(dir, lane));
    const ShearedRay<F> ray = shear(axes, org, dir);
    std::uint32_t hit = 0;
    for (const auto& v : mesh.triangles) {
        const TriangleEdges<F> e = triangle_edges(ray, vertex(axes, mesh.vertices[static_cast<std::size_t>(v[0])]),
                                                  vertex(axes, mesh.vertices[static_cast<std::size_t>(v[1])]),
                                                  vertex(axes, mesh.vertices[static_cast<std::size_t>(v[2])]));
        hit |= bits(e.inside & (triangle_t(ray.shear.z, e) > F(0)));
    }
    return (hit >> lane & 1u) != 0;
}

/// Rays from the eye to a point of an edge or a vertex must hit a triangle around it; returns those that slip through.
std::uint64_t leaks(const ClosedMesh& mesh, const std::array<double, 3>& eye, double jitter, bool at_vertices, int rays,
                    std::uint64_t seed) {
    Lottery random(seed);
    std::uint64_t leaked = 0;
    for (int n = 0; n < rays; n += W) {
        const auto& triangle = mesh.triangles[static_cast<std::size_t>(random.below(static_cast<int>(mesh.triangles.size())))];
        const int edge = random.below(3);
        const auto va = static_cast<std::size_t>(triangle[static_cast<std::size_t>(edge)]);
        const auto vb = static_cast<std::size_t>(triangle[static_cast<std::size_t>((edge + 1) % 3)]);
        alignas(64) S org[3][W], dir[3][W];
        for (int lane = 0; lane < W; ++lane) {
            const double s = at_vertices ? 0 : random.uniform(0, 1);
            double length2 = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double target =
                    static_cast<double>(mesh.vertices[va][axis]) * (1 - s) + static_cast<double>(mesh.vertices[vb][axis]) * s;
                org[axis][lane] = static_cast<S>(static_cast<float>(eye[axis] + random.uniform(-jitter, jitter)));
                dir[axis][lane] = static_cast<S>(static_cast<float>(target - static_cast<double>(org[axis][lane])));
                length2 += static_cast<double>(dir[axis][lane]) * static_cast<double>(dir[axis][lane]);
            }
            if (random.chance(0.5))
                for (auto& row : dir)
                    row[lane] = static_cast<S>(static_cast<float>(static_cast<double>(row[lane]) / std::sqrt(length2)));
        }
        std::uint32_t hit = 0;
        for (int kz = 0; kz < 3; ++kz) {
            std::uint32_t lanes = 0;
            for (int lane = 0; lane < W; ++lane) lanes |= (dominant(dir, lane) == kz ? 1u : 0u) << lane;
            if (lanes == 0) continue;
            const Axes axes = axes_of(kz);
            const ShearedRay<F> ray = shear(axes, org, dir);
            const auto test = [&](int t) {
                const auto& v = mesh.triangles[static_cast<std::size_t>(t)];
                const TriangleEdges<F> e = triangle_edges(ray, vertex(axes, mesh.vertices[static_cast<std::size_t>(v[0])]),
                                                          vertex(axes, mesh.vertices[static_cast<std::size_t>(v[1])]),
                                                          vertex(axes, mesh.vertices[static_cast<std::size_t>(v[2])]));
                hit |= bits(e.inside & (triangle_t(ray.shear.z, e) > F(0))) & lanes;
            };
            for (const int t : mesh.of_vertex[va]) test(t);
            if (!at_vertices)
                for (const int t : mesh.of_vertex[vb]) test(t);
        }
        // past a silhouette, or grazing, the rounded direction may meet another triangle; a closed mesh lets none through
        for (int lane = 0; lane < W; ++lane)
            if ((hit >> lane & 1u) == 0 && !hits_any(mesh, org, dir, lane)) ++leaked;
    }
    return leaked;
}

void check_leaks(const std::string& name, const ClosedMesh& mesh, const std::array<double, 3>& eye, double jitter) {
    INFO(name);
    CHECK(leaks(mesh, eye, jitter, false, cases(1000000), 1) == 0);
    CHECK(leaks(mesh, eye, jitter, true, cases(1000000), 2) == 0);
}

} // namespace

TEST_CASE("no ray slips between the triangles of a closed mesh, at edges and vertices") {
    const FlushDenormals flush;
    const auto plain = [](double x, double y, double z) { return std::array<double, 3>{x, y, z}; };
    check_leaks("UV sphere", sphere_mesh(100, 0, plain), {0, 0, 0}, 0.3);
    check_leaks("displaced sphere", sphere_mesh(55, 0.1, plain), {0, 0, 0}, 0.2);
    // 300 times longer than wide quads on a sphere 1:30 make needles of 1:1e4
    const auto needle = [](double x, double y, double z) { return std::array<double, 3>{0.01 * x, y, 0.01 * z}; };
    check_leaks("needles", sphere_mesh(60, 0, needle), {0, 0, 0}, 0.003);
    for (const double offset : {10.0, 1e3, 1e5}) {
        const auto away = [&](double x, double y, double z) {
            return std::array<double, 3>{x + offset, y - offset, z + 0.7 * offset};
        };
        INFO("offset ", offset);
        // vertices that round to one are degenerate but closed all the same
        CHECK(leaks(sphere_mesh(20, 0.1, away), {offset, -offset, 0.7 * offset}, 0.2, false, cases(200000), 3) == 0);
        CHECK(leaks(sphere_mesh(20, 0.1, away), {offset, -offset, 0.7 * offset}, 0.2, true, cases(200000), 4) == 0);
    }
    for (const double scale : {1e-9, 1e-3, 1e6, 1e12}) {
        const auto sized = [&](double x, double y, double z) { return std::array<double, 3>{x * scale, y * scale, z * scale}; };
        INFO("scale ", scale);
        CHECK(leaks(sphere_mesh(20, 0.1, sized), {0, 0, 0}, 0.2 * scale, false, cases(200000), 5) == 0);
        CHECK(leaks(sphere_mesh(20, 0.1, sized), {0, 0, 0}, 0.2 * scale, true, cases(200000), 6) == 0);
    }
}

TEST_CASE("t is accurate and inside the depth range of the triangle") {
    Lottery random(7);
    const FlushDenormals flush;
    const auto measure = [&](double stretch, std::vector<double>& errors) {
        std::uint64_t outside = 0, hits = 0;
        for (int n = 0; n < cases(400000); n += W) {
            std::array<std::array<double, 3>, 3> corner;
            const std::array<double, 3> along = random.direction();
            for (auto& c : corner) {
                const double s = random.uniform(-stretch, stretch);
                for (std::size_t axis = 0; axis < 3; ++axis) c[axis] = random.uniform(-1, 1) + along[axis] * s;
            }
            Point v[3];
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t axis = 0; axis < 3; ++axis) v[i][axis] = static_cast<float>(corner[i][axis] / stretch);
            alignas(64) S org[3][W], dir[3][W];
            const int kz = random.below(3);
            const std::array<double, 3> from = random.direction();
            for (int lane = 0; lane < W; ++lane) {
                double b1 = random.uniform(0, 1), b2 = random.uniform(0, 1);
                if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double target = static_cast<double>(v[0][axis]) * (1 - b1 - b2) + static_cast<double>(v[1][axis]) * b1 +
                                          static_cast<double>(v[2][axis]) * b2;
                    org[axis][lane] =
                        static_cast<S>(static_cast<float>(from[axis] * 5 * (static_cast<int>(axis) == kz ? 1.5 : 1)));
                    dir[axis][lane] = static_cast<S>(static_cast<float>(target - static_cast<double>(org[axis][lane])));
                }
            }
            for (int k = 0; k < 3; ++k) {
                const Axes axes = axes_of(k);
                const ShearedRay<F> ray = shear(axes, org, dir);
                const TriangleEdges<F> e = triangle_edges(ray, vertex(axes, v[0]), vertex(axes, v[1]), vertex(axes, v[2]));
                alignas(64) S t[W];
                lanecast::store(t, triangle_t(ray.shear.z, e));
                const std::uint32_t inside = bits(e.inside);
                for (int lane = 0; lane < W; ++lane) {
                    if ((inside >> lane & 1u) == 0 || dominant(dir, lane) != k) continue;
                    if (t[lane] != t[lane]) continue; // seen exactly edge-on: no range accepts it
                    ++hits;
                    long double e1[3], e2[3], s[3], d[3];
                    long double lo = 1e30L, hi = -1e30L;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        d[axis] = static_cast<long double>(dir[axis][lane]);
                        e1[axis] = static_cast<long double>(v[1][axis]) - static_cast<long double>(v[0][axis]);
                        e2[axis] = static_cast<long double>(v[2][axis]) - static_cast<long double>(v[0][axis]);
                        s[axis] = static_cast<long double>(v[0][axis]) - static_cast<long double>(org[axis][lane]);
                    }
                    for (const Point& p : v) {
                        const auto z = static_cast<std::size_t>(k);
                        const long double depth =
                            (static_cast<long double>(p[z]) - static_cast<long double>(org[z][lane])) / d[z];
                        lo = std::min(lo, depth), hi = std::max(hi, depth);
                    }
                    const long double cross[3] = {e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2],
                                                  e1[0] * e2[1] - e1[1] * e2[0]};
                    const long double nd = cross[0] * d[0] + cross[1] * d[1] + cross[2] * d[2];
                    const long double length = std::sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]) *
                                               std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                    const long double exact = (cross[0] * s[0] + cross[1] * s[1] + cross[2] * s[2]) / nd;
                    const auto ti = static_cast<long double>(t[lane]);
                    // a convex combination of the depths, to within its rounding
                    const long double slack =
                        8 * 0x1p-24L * static_cast<long double>(ulp_of_s) * std::max(std::fabs(lo), std::fabs(hi));
                    if (!(ti >= lo - slack && ti <= hi + slack)) ++outside;
                    if (std::fabs(nd) < 0.1L * length) continue; // grazing: conditioning, not the formula
                    errors.push_back(static_cast<double>(std::fabs(ti - exact) / (exact * 0x1p-24L)) / ulp_of_s / 2);
                }
            }
        }
        CHECK(outside == 0);
        CHECK(hits > static_cast<std::uint64_t>(cases(400000)) / 4);
        std::sort(errors.begin(), errors.end());
        return errors[errors.size() * 99 / 100];
    };
    std::vector<double> plain, needles;
    const double plain_99 = measure(1, plain), needle_99 = measure(1e4, needles);
    MESSAGE("t in ulp, 99 %: ", plain_99, ", needles 1:1e4: ", needle_99);
    CHECK(plain_99 <= 4);
    CHECK(needle_99 <= 500);
}

TEST_CASE("degenerate and edge-on triangles are not hit, or have a t in range; NaN is never in range") {
    Lottery random(8);
    const FlushDenormals flush;
    std::uint64_t hits = 0, bad = 0;
    for (int n = 0; n < cases(400000); n += W) {
        Point v[3];
        const int kind = random.below(5);
        for (auto& p : v)
            for (auto& x : p) x = static_cast<float>(random.uniform(-1, 1));
        if (kind == 0) v[1] = v[0];
        if (kind == 1) v[2] = v[1] = v[0];
        if (kind == 2) // three on a line
            for (std::size_t axis = 0; axis < 3; ++axis) v[2][axis] = 2 * v[1][axis] - v[0][axis];
        const int kz = random.below(3);
        if (kind == 3) // holds the direction of the rays below
            for (std::size_t axis = 0; axis < 3; ++axis) v[2][axis] = v[0][axis] + (static_cast<int>(axis) == kz ? 0.5f : 0.0f);
        alignas(64) S org[3][W], dir[3][W];
        for (int lane = 0; lane < W; ++lane)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool main_axis = static_cast<int>(axis) == kz;
                org[axis][lane] = static_cast<S>(main_axis ? -3.0f : v[random.below(2)][axis]);
                dir[axis][lane] = static_cast<S>(main_axis   ? 1.0f
                                                 : kind == 3 ? 0.0f
                                                             : static_cast<float>(random.uniform(-0.01, 0.01)));
            }
        const Axes axes = axes_of(kz);
        const ShearedRay<F> ray = shear(axes, org, dir);
        const TriangleEdges<F> e = triangle_edges(ray, vertex(axes, v[0]), vertex(axes, v[1]), vertex(axes, v[2]));
        const F t = triangle_t(ray.shear.z, e);
        const std::uint32_t found = bits(e.inside & (t > F(0)) & (t <= F(no_limit<S>)));
        hits += static_cast<std::uint64_t>(std::popcount(found));
        bad += static_cast<std::uint64_t>(std::popcount(found & ~bits((t >= F(S(1.9))) & (t <= F(S(4.1))))));
        if (kind <= 1 && found != 0) ++bad; // a point or a doubled edge has no area
    }
    CHECK(bad == 0);
    CHECK(hits > 0);
}

TEST_CASE("a ray in the plane of a triangle does not hit it beside itself") {
    Lottery random(9);
    const FlushDenormals flush;
    std::uint64_t ties = 0, hits = 0;
    for (int n = 0; n < cases(2000000); n += W) {
        // a direction, and a triangle that lies `beside` to one side of the ray along it
        const auto d = random.direction(), side = random.direction();
        Point v[3];
        double depth[3], beside[3];
        for (std::size_t k = 0; k < 3; ++k) {
            depth[k] = random.uniform(1, 2);
            beside[k] = random.magnitude(1e-3, 1);
        }
        alignas(64) S org[3][W], dir[3][W];
        std::array<double, 3> from{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            from[axis] = random.uniform(-1, 1);
            for (std::size_t k = 0; k < 3; ++k)
                v[k][axis] = static_cast<float>(from[axis] + depth[k] * d[axis] + beside[k] * side[axis]);
        }
        for (int lane = 0; lane < W; ++lane)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                org[axis][lane] = static_cast<S>(from[axis] + 1e-3 * lane * d[axis]);
                dir[axis][lane] = static_cast<S>(d[axis]);
            }
        const Axes axes = axes_of(dominant(dir, 0));
        const ShearedRay<F> ray = shear(axes, org, dir);
        const TriangleEdges<F> e = triangle_edges(ray, vertex(axes, v[0]), vertex(axes, v[1]), vertex(axes, v[2]));
        ties += static_cast<std::uint64_t>(std::popcount(bits((e.u == F(0)) | (e.v == F(0)) | (e.w == F(0)))));
        const F t = triangle_t(ray.shear.z, e);
        hits += static_cast<std::uint64_t>(std::popcount(bits(e.inside & (t > F(0)) & (t <= F(no_limit<S>)))));
    }
    CHECK((sizeof(S) == sizeof(double) || ties > 0)); // of float vertices in double none are exact
    CHECK(hits == 0);
}

TEST_CASE("signs: a triangle is met where comparing the products of each edge says so, on lattices, tiny and huge") {
    Lottery random(10);
    const FlushDenormals flush;
    std::uint64_t hits = 0, ties = 0, beside = 0, wrong = 0;
    for (int n = 0; n < cases(4000000); n += W) {
        const int kind = random.below(4);
        const double size = kind < 2 ? 1 : kind == 2 ? random.magnitude(1e-26, 1e-14) : random.magnitude(1e14, 1e22);
        alignas(64) S in[12][W];
        for (int row = 0; row < 12; ++row)
            for (S& number : in[row])
                number = static_cast<S>(static_cast<float>(row >= 9    ? 0.5 * (random.below(5) - 2)
                                                           : kind == 1 ? random.uniform(-1, 1)
                                                                       : size * (random.below(5) - 2)));
        const auto vector = [&](int row) { return Vec3<F>{load<F>(in[row]), load<F>(in[row + 1]), load<F>(in[row + 2])}; };
        const TriangleEdges<F> e = triangle_edges(vector(9), vector(0), vector(3), vector(6));
        alignas(64) S depths[W];
        lanecast::store(depths, triangle_t(vector(9).z, e));
        const std::uint32_t inside = bits(e.inside);
        for (int lane = 0; lane < W; ++lane) {
            const auto sheared = [&](int row, int axis) {
                return less_product<S>(in[row + axis][lane], in[9 + axis][lane], in[row + 2][lane]);
            };
            const S ax = sheared(0, 0), ay = sheared(0, 1), bx = sheared(3, 0), by = sheared(3, 1), cx = sheared(6, 0),
                    cy = sheared(6, 1);
            const S u0 = cx * by, u1 = cy * bx, v0 = ax * cy, v1 = ay * cx, w0 = bx * ay, w1 = by * ax;
            const bool on = (u0 >= u1 && v0 >= v1 && w0 >= w1) || (u0 <= u1 && v0 <= v1 && w0 <= w1);
            const bool spans = std::min(ax * bx, ax * cx) <= 0 && std::min(ay * by, ay * cy) <= 0;
            if (depths[lane] != depths[lane]) continue; // no range accepts it
            const bool says = (inside >> lane & 1u) != 0;
            wrong += says != (on && spans);
            hits += says;
            ties += on && (u0 == u1 || v0 == v1 || w0 == w1);
            beside += on && !spans;
        }
    }
    CHECK(wrong == 0);
    CHECK(hits > 10000u / fewer);
    CHECK(ties > 10000u / fewer);
    CHECK((sizeof(S) == sizeof(double) || beside > 100u / fewer)); // of floats doubles lose nothing
}
