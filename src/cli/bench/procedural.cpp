// Deterministic meshes for measuring: integers and IEEE double only, so that every machine gets the same ones.

#include "cli/bench/bench_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace lanecast::bench {
namespace {

std::uint32_t add_vertex(BenchMesh& mesh, const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back(static_cast<float>(p[axis]));
    return static_cast<std::uint32_t>(mesh.positions.size() / 3 - 1);
}

void add_triangle(BenchMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void add_quad(BenchMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

/// A grid of (columns + 1) x (rows + 1) points, each cell two triangles.
template <class Point>
void add_grid(BenchMesh& mesh, std::uint32_t columns, std::uint32_t rows, Point&& point) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size() / 3);
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i) static_cast<void>(add_vertex(mesh, point(i, j)));
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = first + j * (columns + 1) + i;
            add_quad(mesh, a, a + 1, a + columns + 2, a + columns + 1);
        }
}

// ---- sphereflake: a sphere with nine a third its size on it, and so on ----

void add_sphere(BenchMesh& mesh, const glm::dvec3& centre, double radius) {
    constexpr std::uint32_t slices = 14, stacks = 6; // 140 triangles
    const auto on_sphere = [&](std::uint32_t i, std::uint32_t j) {
        const double phi = 2 * std::numbers::pi * i / slices, theta = std::numbers::pi * j / stacks;
        return centre + radius * glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    };
    const std::uint32_t top = add_vertex(mesh, on_sphere(0, 0));
    const std::uint32_t first = top + 1;
    for (std::uint32_t j = 1; j < stacks; ++j)
        for (std::uint32_t i = 0; i < slices; ++i) static_cast<void>(add_vertex(mesh, on_sphere(i, j)));
    const std::uint32_t bottom = add_vertex(mesh, on_sphere(0, stacks));
    for (std::uint32_t i = 0; i < slices; ++i) {
        const std::uint32_t next = (i + 1) % slices, last = first + (stacks - 2) * slices;
        add_triangle(mesh, top, first + next, first + i);
        for (std::uint32_t j = 0; j + 2 < stacks; ++j) {
            const std::uint32_t row = first + j * slices;
            add_quad(mesh, row + i, row + next, row + slices + next, row + slices + i);
        }
        add_triangle(mesh, last + i, last + next, bottom);
    }
}

void add_flake(BenchMesh& mesh, const glm::dvec3& centre, double radius, const glm::dvec3& axis, int levels) {
    add_sphere(mesh, centre, radius);
    if (levels == 0) return;
    const glm::dvec3 side = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 third = glm::cross(axis, side);
    for (int k = 0; k < 9; ++k) { // six around the equator, three above
        const double turn = k < 6 ? k / 6.0 : (k - 6) / 3.0 + 1.0 / 12;
        const double lift = k < 6 ? 0 : 0.955; // radians
        const double angle = 2 * std::numbers::pi * turn;
        const glm::dvec3 out = std::cos(lift) * (std::cos(angle) * side + std::sin(angle) * third) + std::sin(lift) * axis;
        add_flake(mesh, centre + out * (radius * 4 / 3), radius / 3, glm::normalize(out), levels - 1);
    }
}

// ---- terrain: midpoint displacement ----

/// In [-1, 1), a function of the place alone.
double noise(std::uint32_t x, std::uint32_t y) {
    std::uint32_t h = x * 0x9e3779b1u ^ (y + 0x7f4a7c15u) * 0x85ebca6bu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<double>(h ^ h >> 15) / 2147483648.0 - 1;
}

// ---- hall ----

void add_box(BenchMesh& mesh, const glm::dvec3& lo, const glm::dvec3& hi) {
    std::uint32_t v[8];
    for (std::uint32_t i = 0; i < 8; ++i)
        v[i] = add_vertex(mesh, {(i & 1u) ? hi.x : lo.x, (i & 2u) ? hi.y : lo.y, (i & 4u) ? hi.z : lo.z});
    add_quad(mesh, v[0], v[2], v[3], v[1]);
    add_quad(mesh, v[4], v[5], v[7], v[6]);
    add_quad(mesh, v[0], v[1], v[5], v[4]);
    add_quad(mesh, v[2], v[6], v[7], v[3]);
    add_quad(mesh, v[0], v[4], v[6], v[2]);
    add_quad(mesh, v[1], v[3], v[7], v[5]);
}

/// Fluted and swelling, on a square base, under a square plate.
void add_column(BenchMesh& mesh, double x, double z, double height) {
    constexpr std::uint32_t around = 96, up = 24;
    add_grid(mesh, around, up, [&](std::uint32_t i, std::uint32_t j) {
        const double angle = 2 * std::numbers::pi * (i % around) / around, h = static_cast<double>(j) / up;
        const double radius =
            (0.4 - 0.08 * h + 0.03 * std::sin(std::numbers::pi * h)) * (1 - 0.06 * std::abs(std::sin(8 * angle)));
        return glm::dvec3(x + radius * std::cos(angle), 0.3 + h * (height - 0.6), z + radius * std::sin(angle));
    });
    add_box(mesh, {x - 0.55, 0, z - 0.55}, {x + 0.55, 0.3, z + 0.55});
    add_box(mesh, {x - 0.5, height - 0.3, z - 0.5}, {x + 0.5, height, z + 0.5});
}

/// A round arch from column to column, along x or z.
void add_arch(BenchMesh& mesh, const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 along = 0.5 * (to - from), middle = 0.5 * (from + to);
    const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0))) * 0.3;
    const double radius = glm::length(along);
    add_grid(mesh, 24, 8, [&](std::uint32_t i, std::uint32_t j) {
        const double angle = std::numbers::pi * i / 24, side = std::cos(2 * std::numbers::pi * j / 8);
        const double r = 1 + 0.12 * std::sin(2 * std::numbers::pi * j / 8);
        return middle - along * (r * std::cos(angle)) + glm::dvec3(0, radius * r * std::sin(angle), 0) + across * side;
    });
}

} // namespace

BenchMesh make_flake() {
    BenchMesh mesh;
    mesh.name = "flake";
    add_flake(mesh, {0, 0, 0}, 1, {0, 1, 0}, 4); // 7381 spheres
    return mesh;
}

BenchMesh make_terrain(std::size_t triangles) {
    BenchMesh mesh;
    mesh.name = "terrain";
    const auto size =
        static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(std::max<std::size_t>(triangles, 2)) / 2)));
    const std::uint32_t largest_hills = std::bit_floor(std::max(size * 3 / 8, 1u)); // the same shape at every size
    add_grid(mesh, size, size, [&](std::uint32_t i, std::uint32_t j) {
        double height = 0;
        double amplitude = 0.35;
        for (std::uint32_t period = largest_hills; period >= 1; period /= 2, amplitude *= 0.52) {
            const std::uint32_t x = i / period, y = j / period;
            const double fx = static_cast<double>(i % period) / period, fy = static_cast<double>(j % period) / period;
            const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
            const double a = noise(x * period, y * period), b = noise((x + 1) * period, y * period);
            const double c = noise(x * period, (y + 1) * period), d = noise((x + 1) * period, (y + 1) * period);
            height += amplitude * ((1 - sy) * ((1 - sx) * a + sx * b) + sy * ((1 - sx) * c + sx * d));
        }
        return glm::dvec3(4.0 * j / size - 2, height, 4.0 * i / size - 2); // counter-clockwise seen from above
    });
    return mesh;
}

BenchMesh make_hall() {
    BenchMesh mesh;
    mesh.name = "hall";
    constexpr int columns = 19; // per row
    constexpr double pitch = 3, height = 6, length = (columns - 1) * pitch, width = 18;
    const double rows[] = {0, 6, 12, width};
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < columns; ++i) {
            add_column(mesh, i * pitch, rows[row], height);
            if (i > 0) add_arch(mesh, {(i - 1) * pitch, height, rows[row]}, {i * pitch, height, rows[row]});
        }
    // floor of tiles with bevelled gaps, walls and a barrel vault with ribs
    add_grid(mesh, 240, 120, [&](std::uint32_t i, std::uint32_t j) {
        return glm::dvec3(-3 + (length + 6) * j / 120, (i % 4 == 0 || j % 4 == 0) ? -0.02 : 0.0, -3 + (width + 6) * i / 240.0);
    });
    for (const double z : {-3.0, width + 3})
        add_grid(mesh, 60, 20,
                 [&](std::uint32_t i, std::uint32_t j) { return glm::dvec3(-3 + (length + 6) * i / 60, 0.45 * j, z); });
    for (const double x : {-3.0, length + 3})
        add_grid(mesh, 40, 40,
                 [&](std::uint32_t i, std::uint32_t j) { return glm::dvec3(x, 0.55 * j, -3 + (width + 6) * i / 40); });
    add_grid(mesh, 200, 160, [&](std::uint32_t i, std::uint32_t j) {
        const double angle = std::numbers::pi * j / 160, rib = i % 10 < 2 ? 0.25 : 0;
        return glm::dvec3(-3 + (length + 6) * i / 200, 9 + (12 - rib) * std::sin(angle),
                          width / 2 - (12 - rib) * std::cos(angle));
    });
    return mesh;
}

} // namespace lanecast::bench
