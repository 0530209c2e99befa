#pragma once
// Random triangles and rays for the public interface, and a brute-force truth in double that shares nothing with it.

#include "lanecast/lanecast.hpp"
#include "scene/geometry_support.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

namespace lanecast::test {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

struct TestMesh {
    std::vector<float> positions; ///< `floats` per vertex, the first three are x y z
    std::vector<std::uint32_t> indices;
    std::size_t floats = 3;

    [[nodiscard]] MeshArrays arrays() const {
        return {positions.data(), positions.size() / floats, indices.data(), indices.size() / 3, floats * sizeof(float)};
    }
    [[nodiscard]] glm::dvec3 vertex(std::uint32_t triangle, std::uint32_t corner) const {
        const float* const p = &positions[indices[3 * triangle + corner] * floats];
        return {p[0], p[1], p[2]};
    }
};

/// Triangles of all sizes in a cube around `centre`; some are degenerate. Vertices have what else the caller keeps with them.
inline TestMesh random_mesh(Random& random, int triangles, double size = 1, const glm::dvec3& centre = glm::dvec3(0)) {
    TestMesh mesh;
    mesh.floats = 3 + static_cast<std::size_t>(random.below(4));
    for (int i = 0; i < triangles; ++i) {
        const glm::dvec3 middle = random.point(size), a = random.point(size * 0.3), b = random.point(size * 0.3);
        const bool degenerate = random.chance(0.02);
        for (const glm::dvec3& p : {middle, middle + a, degenerate ? middle : middle + b}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size() / mesh.floats));
            for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(static_cast<float>(centre[axis] + p[axis]));
            for (std::size_t k = 3; k < mesh.floats; ++k) mesh.positions.push_back(std::numeric_limits<float>::quiet_NaN());
        }
    }
    return mesh;
}

/// Arrays that do not start on a boundary of anything but a float, with guards around each.
class Floats {
public:
    explicit Floats(std::size_t count, float value = 0, std::size_t shift = 1)
        : begin_(guard + shift), count_(count), all_(begin_ + count + guard, guard_value) {
        std::fill_n(all_.begin() + static_cast<std::ptrdiff_t>(begin_), count, value);
    }
    [[nodiscard]] float* data() { return all_.data() + begin_; }
    [[nodiscard]] const float* data() const { return all_.data() + begin_; }
    [[nodiscard]] std::size_t size() const { return count_; }
    float& operator[](std::size_t i) { return all_[begin_ + i]; }
    const float& operator[](std::size_t i) const { return all_[begin_ + i]; }
    [[nodiscard]] bool guards_untouched() const {
        for (std::size_t i = 0; i < all_.size(); ++i)
            if ((i < begin_ || i >= begin_ + count_) && all_[i] != guard_value) return false;
        return true;
    }

private:
    static constexpr std::size_t guard = 32;
    static constexpr float guard_value = 12345;
    std::size_t begin_, count_;
    std::vector<float> all_;
};

struct TestRays {
    std::array<Floats, 3> org, dir;
    Floats tmin, tmax;
    explicit TestRays(std::size_t n)
        : org{Floats(n, 0, 1), Floats(n, 0, 2), Floats(n, 0, 3)}, dir{Floats(n, 0, 5), Floats(n, 0, 7), Floats(n, 0, 1)},
          tmin(n, 0, 3), tmax(n, infinity, 2) {}
    [[nodiscard]] std::size_t size() const { return tmin.size(); }
    void set(std::size_t i, const glm::dvec3& o, const glm::dvec3& d) {
        for (int axis = 0; axis < 3; ++axis) {
            org[static_cast<std::size_t>(axis)][i] = static_cast<float>(o[axis]);
            dir[static_cast<std::size_t>(axis)][i] = static_cast<float>(d[axis]);
        }
    }
    [[nodiscard]] RayArrays arrays(std::size_t begin, std::size_t count) const {
        RayArrays rays;
        rays.org_x = org[0].data() + begin;
        rays.org_y = org[1].data() + begin;
        rays.org_z = org[2].data() + begin;
        rays.dir_x = dir[0].data() + begin;
        rays.dir_y = dir[1].data() + begin;
        rays.dir_z = dir[2].data() + begin;
        rays.tmin = tmin.data() + begin;
        rays.tmax = tmax.data() + begin;
        rays.count = count;
        return rays;
    }
    [[nodiscard]] RayArrays arrays() const { return arrays(0, size()); }
    [[nodiscard]] glm::dvec3 origin(std::size_t i) const { return {org[0][i], org[1][i], org[2][i]}; }
    [[nodiscard]] glm::dvec3 direction(std::size_t i) const { return {dir[0][i], dir[1][i], dir[2][i]}; }
};

/// From everywhere to everywhere, directions of all lengths, some with a range.
inline TestRays random_rays(Random& random, std::size_t n, double size = 1, const glm::dvec3& centre = glm::dvec3(0)) {
    TestRays rays(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double length = std::exp(random.uniform(-5, 5));
        const glm::dvec3 o = random.point(2 * size), d = random.chance(0.7) ? random.point(size) - o : random.direction();
        rays.set(i, centre + o, glm::normalize(d) * length);
        if (random.chance(0.2)) rays.tmin[i] = static_cast<float>(size / length * random.uniform(-1, 1));
        if (random.chance(0.2)) rays.tmax[i] = static_cast<float>(size / length * random.uniform(0, 3));
    }
    return rays;
}

struct TestHits {
    Floats t, nx, ny, nz, u, v;
    std::vector<std::uint32_t> object, primitive;
    explicit TestHits(std::size_t n)
        : t(n, -7), nx(n, -7), ny(n, -7, 2), nz(n, -7, 3), u(n, -7, 5), v(n, -7, 7), object(n, 77), primitive(n, 77) {}
    [[nodiscard]] HitArrays arrays(std::size_t begin = 0) {
        return {t.data() + begin,  object.data() + begin, primitive.data() + begin, nx.data() + begin,
                ny.data() + begin, nz.data() + begin,     u.data() + begin,         v.data() + begin};
    }
    [[nodiscard]] bool guards_untouched() const {
        return t.guards_untouched() && nx.guards_untouched() && ny.guards_untouched() && nz.guards_untouched() &&
               u.guards_untouched() && v.guards_untouched();
    }
    /// Bit by bit.
    [[nodiscard]] bool same(std::size_t i, const TestHits& other, std::size_t j) const {
        const auto equal = [&](const Floats& a, const Floats& b) {
            return std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[j]);
        };
        return equal(t, other.t) && equal(nx, other.nx) && equal(ny, other.ny) && equal(nz, other.nz) && equal(u, other.u) &&
               equal(v, other.v) && object[i] == other.object[j] && primitive[i] == other.primitive[j];
    }
};

/// Moeller and Trumbore in double; NaN for a miss. `margin`: the least of the three weights; near 0 on an edge.
inline double truth(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    double& margin) {
    const glm::dvec3 e1 = b - a, e2 = c - a, p = glm::cross(d, e2);
    const double det = glm::dot(e1, p);
    const glm::dvec3 s = o - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
    margin = std::min({u, v, 1 - u - v});
    return margin >= 0 ? glm::dot(e2, q) / det : std::nan("");
}

} // namespace lanecast::test
