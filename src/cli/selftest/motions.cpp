// N6, N7: a scene that is moved by steps of the grid, turned by quarters or mirrored is the same scene.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/scenes.hpp"
#include "cli/selftest/wiggle.hpp"
#include "scene/flatten.hpp"
#include "scene/transform.hpp"

#include <cmath>

namespace lanecast::selftest {
namespace {

glm::dvec3 on_grid(const glm::dvec3& p, double step) { return glm::round(p / step) * step; }

/// Lengths and places on a grid of 2^-8.
SceneDescription grid_scene(PrimitiveKind kind, Random& random) {
    constexpr double step = 0x1p-8;
    SceneDescription scene;
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 place = on_grid(random.point(3), step);
        Object object = random_object(kind, Placing::plain, place, random);
        if (auto* mesh = std::get_if<Mesh>(&object.shape))
            for (glm::dvec3& p : mesh->positions) p = on_grid(p, step);
        scene.objects.push_back(object);
    }
    if (kind == PrimitiveKind::plane) add_object(scene, Sphere{1, {0, 0, 0}});
    return scene;
}

/// That do not start on a surface, where t is nothing but rounding: from anywhere, along the axes from lattice points, and at
/// edges.
Rays free_rays(const SceneArrays& scene, std::uint64_t count, Random& random) {
    Rays rays;
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 o = random.point(3);
        if (i % 4 == 0) {
            const glm::dvec3 way(random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
            rays.add(glm::dvec3(random.below(9) - 4, random.below(9) - 4, random.below(9) - 4) * 0.25, way);
        } else {
            rays.add(o, i % 4 == 1 ? random_target(scene, random) - o : random.direction());
        }
    }
    return rays;
}

} // namespace

/// By up to 2^12, with a marker left behind on the other side, so that it is not moved back. Error: of the point along the
/// normal, in units of u |T|.
void test_translated(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneDescription scene = grid_scene(s.primitive, random);
    const glm::dvec3 move = on_grid(random.direction() * random.magnitude(8, 4096), 1.0 / 8);
    SceneDescription moved = scene;
    for (Object& object : moved.objects) {
        if (auto* plane = std::get_if<Plane>(&object.shape))
            plane->position += move;
        else
            object.transformations.emplace_back(Translation{move});
    }
    add_object(moved, Sphere{0.125, -move});
    const SceneArrays here = flatten(scene, RenderSettings{}, 1), there = flatten(moved, RenderSettings{}, 1);
    Rays rays, moved_rays;
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        const glm::dvec3 o = on_grid(random.point(4), 0x1p-8), d = random.direction();
        rays.add(o, d);
        moved_rays.add(o + move, d);
    }
    const WorldHits a = ask_in_world(*s.kernels, here, rays, s.path), b = ask_in_world(*s.kernels, there, moved_rays, s.path);
    const double unit = 0x1p-24 * glm::length(move);
    const auto object_of = [](const SceneArrays& arrays, std::int32_t slot) {
        return slot < 0 ? -1 : static_cast<int>(arrays.object[static_cast<std::size_t>(slot)]);
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const int from = object_of(here, a.slot[i]), to = object_of(there, b.slot[i]);
        if (to == static_cast<int>(moved.objects.size()) - 1) continue; // the marker
        ++tally.rays;
        if (from != to) {
            // planes are stored by their distance, which is rounded where it is large
            if (s.primitive != PrimitiveKind::plane) tally.fail("ray " + std::to_string(i) + ": another object");
            continue;
        }
        if (from < 0) continue;
        const glm::dvec3 n(b.normal[0][i], b.normal[1][i], b.normal[2][i]);
        tally.add_error(std::fabs((double{b.t[i]} - double{a.t[i]}) * glm::dot(rays.d(i), n)) / unit);
    }
}

namespace {

/// The same triangle of both scenes, whose stored normals do not turn as `linear` does.
bool turns_over(const SceneArrays& a, std::int32_t from, const SceneArrays& b, std::int32_t to, const glm::dmat3& linear) {
    if (from < 0 || to < 0) return false;
    const auto i = static_cast<std::size_t>(from), k = static_cast<std::size_t>(to);
    if (i >= a.first_slot[1] || k >= b.first_slot[1] || a.scene_id[i] != b.scene_id[k]) return false;
    const auto &m = a.triangles[i].normal, &n = b.triangles[k].normal;
    return glm::length(linear * glm::dvec3(m[0], m[1], m[2]) - glm::dvec3(n[0], n[1], n[2])) > 1e-6;
}

} // namespace

/// Turned by quarters and mirrored at will: exact in every coordinate.
void test_turned(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneDescription scene = random_scene(s.primitive, s.placing, 4 + random.below(24), random);
    std::vector<Transformation> turn;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0);
        axis[random.below(3)] = 1;
        turn.emplace_back(Rotation{axis, 90.0 * random.below(4)});
    }
    if (random.chance(0.5)) turn.emplace_back(Scale{{-1, 1, 1}});
    const glm::dmat3 linear = compose(turn).linear;
    for (int column = 0; column < 3; ++column)
        if (linear[column] != glm::round(linear[column])) tally.fail("a turn by quarters is not exact");
    SceneDescription turned = scene;
    for (Object& object : turned.objects) {
        if (auto* plane = std::get_if<Plane>(&object.shape))
            plane->position = linear * plane->position, plane->normal = linear * plane->normal;
        else
            object.transformations.insert(object.transformations.end(), turn.begin(), turn.end());
    }
    const SceneArrays a = flatten(scene, RenderSettings{}, 1), b = flatten(turned, RenderSettings{}, 1);
    // the centre is the roundest number about: it may turn to another one
    if (glm::length(linear * a.normalisation.centre - b.normalisation.centre) > 0 ||
        a.normalisation.scale != b.normalisation.scale)
        return;
    const Rays rays = free_rays(a, block.rays, random);
    Rays turned_rays;
    for (std::size_t i = 0; i < rays.size(); ++i) turned_rays.add(linear * rays.o(i), linear * rays.d(i));
    const Hits first = ask(*s.kernels, view(a), rays, s.path), second = ask(*s.kernels, view(b), turned_rays, s.path);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const int from = first.slot[i] < 0 ? -1 : static_cast<int>(a.object[static_cast<std::size_t>(first.slot[i])]);
        const int to = second.slot[i] < 0 ? -1 : static_cast<int>(b.object[static_cast<std::size_t>(second.slot[i])]);
        ++tally.rays;
        const double error = from < 0 ? 0 : ulps(second.t[i], double{first.t[i]});
        if (turns_over(a, first.slot[i], b, second.slot[i], linear)) tally.fail("ray " + std::to_string(i) + ": another normal");
        if (from == to && error <= 4) continue;
        if (!is_answer(view(a), rays.o(i), rays.d(i), 16, to, second.t[i]) ||
            !is_answer(view(a), rays.o(i), rays.d(i), 16, from, first.t[i]))
            tally.fail("ray " + std::to_string(i) + ": object " + std::to_string(to) + " instead of " + std::to_string(from) +
                       ", t off by " + std::to_string(error) + " ulp");
    }
}

} // namespace lanecast::selftest
