#include "cli/selftest/meshes.hpp"

#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/objects.hpp"
#include "scene/flatten.hpp"

#include <cmath>
#include <numbers>

namespace lanecast::selftest {
namespace {

/// `stagger`: how far each row of vertices is turned against the one above it, in steps. 0: quads are flat.
template <class Place>
Mesh ball(int rows, double bump, double stagger, Place&& place) {
    Mesh mesh;
    const int n = rows, m = 2 * rows;
    mesh.positions.push_back(place(glm::dvec3(0, 1, 0)));
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double a = std::numbers::pi * i / n, b = 2 * std::numbers::pi * (j + stagger * i) / m;
            const double r = 1 + bump * std::sin(7 * a) * std::cos(5 * b);
            mesh.positions.push_back(
                place(glm::dvec3(r * std::sin(a) * std::cos(b), r * std::cos(a), r * std::sin(a) * std::sin(b))));
        }
    mesh.positions.push_back(place(glm::dvec3(0, -1, 0)));
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    const auto at = [&](int i, int j) {
        return i == 0 ? 0u : i == n ? last : static_cast<std::uint32_t>(1 + (i - 1) * m + j % m);
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) { // counter-clockwise from outside
            if (i > 0) mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            if (i + 1 < n) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
        }
    return mesh;
}

/// [-1, 1] per axis, n x n quads per side, the vertices shared.
Mesh gridded_box(int n) {
    Mesh mesh;
    std::vector<std::uint32_t> number(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)), ~0u);
    const auto vertex = [&](int x, int y, int z) {
        std::uint32_t& index = number[static_cast<std::size_t>((x * (n + 1) + y) * (n + 1) + z)];
        if (index == ~0u) {
            index = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(glm::dvec3(x, y, z) * (2.0 / n) - 1.0);
        }
        return index;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        int p[3];
                        p[axis] = side, p[(axis + 1) % 3] = i + u, p[(axis + 2) % 3] = j + v;
                        return vertex(p[0], p[1], p[2]);
                    };
                    if (side > 0) {
                        mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
                        mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
                    } else {
                        mesh.triangles.push_back({at(0, 0), at(1, 1), at(1, 0)});
                        mesh.triangles.push_back({at(0, 0), at(0, 1), at(1, 1)});
                    }
                }
    return mesh;
}

} // namespace

Mesh closed_mesh(Form form, int detail) {
    switch (form) {
    case Form::ball: // the axes differ
        return ball(detail, 0, 0, [](const glm::dvec3& p) { return p * glm::dvec3(1, 0.8, 0.9); });
    case Form::bumpy:
        return ball(detail, 0.1, 0, [](const glm::dvec3& p) { return p; });
    case Form::needles: { // quads of about 3 / detail, along y; narrowed so that they are 1e4 times longer than wide
        const double narrow = 1.2e-4;
        return ball(detail, 0, 0, [=](const glm::dvec3& p) { return p * glm::dvec3(narrow, 1, narrow); });
    }
    case Form::staggered_ball:
        return ball(detail, 0, 0.5, [](const glm::dvec3& p) { return p * glm::dvec3(1, 0.8, 0.9); });
    case Form::gridded_box:
        break;
    }
    return gridded_box(detail);
}

glm::dvec3 inner_point(Form form, Random& random) {
    const glm::dvec3 p = random.point(form == Form::bumpy ? 0.2 : 0.3);
    return form == Form::needles ? p * glm::dvec3(1.2e-4, 1, 1.2e-4) : p;
}

std::vector<Transformation> random_placing(Placing placing, Random& random) {
    std::vector<Transformation> result;
    switch (placing) {
    case Placing::plain:
        break;
    case Placing::translated:
        result.emplace_back(Translation{random.direction() * random.magnitude(1, 1e5)});
        break;
    case Placing::rotated: {
        glm::dvec3 axis(0);
        axis[random.below(3)] = 1;
        if (random.chance(0.5))
            result.emplace_back(Rotation{axis, 90.0 * (1 + random.below(3))});
        else
            result.emplace_back(Rotation{random.direction(), random.uniform(0, 360)});
        break;
    }
    case Placing::scaled:
        result.emplace_back(Scale{glm::dvec3(random.chance(0.1) ? random.magnitude(1e-15, 1e18) : random.magnitude(1e-3, 1e6))});
        break;
    case Placing::stretched: {
        const auto stretch = [&] {
            return Scale{{random.magnitude(1 / 30.0, 30), random.magnitude(1 / 30.0, 30), random.magnitude(1 / 30.0, 30)}};
        };
        result.emplace_back(stretch());
        result.emplace_back(Rotation{random.direction(), random.uniform(0, 360)});
        if (random.chance(0.3)) result.emplace_back(Scale{{1, random.uniform(0.3, 3), 1}}); // with the turn: sheared
        break;
    }
    case Placing::mirrored:
        result.emplace_back(Scale{random.chance(0.5) ? glm::dvec3(-1, 1, 1) : glm::dvec3(-1, -1, -1)});
        if (random.chance(0.5)) result.emplace_back(Rotation{random.direction(), random.uniform(0, 360)});
        break;
    }
    return result;
}

glm::dvec3 MeshScene::place(const glm::dvec3& p_object) const {
    return (apply(world_from_object, p_object) - arrays.normalisation.centre) * arrays.normalisation.scale;
}

MeshScene make_mesh_scene(Form form, int detail, Placing placing, int leaf_size, Random& random) {
    MeshScene scene;
    scene.form = form;
    SceneDescription description;
    std::vector<Transformation> transformations = random_placing(placing, random);
    if (placing == Placing::translated && form == Form::needles) // farther off they are narrower than the grid
        transformations = {Translation{random.direction() * random.magnitude(1, 10)}};
    if (placing == Placing::stretched && form == Form::needles) // nor is there an inside to start from
        transformations = {Scale{{random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)}},
                           Rotation{random.direction(), random.uniform(0, 360)}};
    scene.world_from_object = compose(transformations);
    add_object(description, closed_mesh(form, detail), transformations);
    if (placing == Placing::translated) add_object(description, Sphere{1e-3, -scene.world_from_object.translation});
    scene.arrays = flatten(description, RenderSettings{}, 1);
    if (leaf_size > 0) scene.arrays = with_leaves_of(scene.arrays, leaf_size);
    return scene;
}

glm::dvec3 corner(const SceneArrays& arrays, std::uint32_t slot, std::uint32_t k) {
    const std::uint32_t block = arrays.triangles[slot].block, n = (block >> 3 & 7u) + 1;
    const auto* rows =
        reinterpret_cast<const float*>(arrays.arena.get() + std::size_t{block >> 6} * 64) + 3 * k * n + (block & 7u);
    return {rows[0], rows[n], rows[2 * n]};
}

} // namespace lanecast::selftest
