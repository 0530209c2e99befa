// What a caller of ray streams meets who has none of the renderer's help: scenes of any scale in its own units, and rays that
// start where the last one ended. For comparing libraries; N5 and N8 proper are pictures.

#include "cli/selftest/caller.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/scenes.hpp"
#include "cli/selftest/wiggle.hpp"
#include "render/dispatch.hpp"
#include "scene/flatten.hpp"

#include <cmath>

namespace lanecast::selftest {
namespace {

/// A scene and rays in the caller's units, and both times 2^k, exactly: the same slots, and t times 2^k.
void compare_scales(const Block& block, int largest, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const int k = random.below(2 * largest + 1) - largest;
    const SceneDescription description = random_scene(s.primitive, s.placing, 4 + random.below(24), random);
    const SceneArrays scene = flatten(description, RenderSettings{}, 1);
    const SceneArrays scaled = flatten(scaled_scene(description, k), RenderSettings{}, 1);
    const Rays normalised = random_rays(scene, block.rays, 100, random);
    Rays rays, scaled_rays;
    for (std::size_t i = 0; i < normalised.size(); ++i) {
        rays.add(normalised.o(i) / scene.normalisation.scale + scene.normalisation.centre, normalised.d(i));
        scaled_rays.add(rays.o(i) * std::ldexp(1.0, k), rays.d(i));
    }
    const WorldHits a = ask_in_world(*s.kernels, scene, rays, s.path);
    const WorldHits b = ask_in_world(*s.kernels, scaled, scaled_rays, s.path);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (a.slot[i] != b.slot[i] || (a.slot[i] >= 0 && bits_of(std::ldexp(a.t[i], k)) != bits_of(b.t[i])))
            tally.fail("ray " + std::to_string(i) + " at 2^" + std::to_string(k) + ": slot " + std::to_string(b.slot[i]) +
                       " instead of " + std::to_string(a.slot[i]) + ", t off by " +
                       std::to_string(ulps(b.t[i], std::ldexp(double{a.t[i]}, k))) + " ulp");
    tally.rays += rays.size();
}

/// The object that each ray hits, -1: none.
int object_of(const SceneArrays& scene, std::int32_t slot) {
    return slot < 0 ? -1 : static_cast<int>(scene.object[static_cast<std::size_t>(slot)]);
}

} // namespace

/// Objects of one kind and meshes: the same one as the double-precision kernels find, or one that they find for the ray moved by
/// its roundings.
void test_streams(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    SceneDescription description;
    for (int i = 4 + random.below(24); i > 0; --i) {
        const PrimitiveKind kind = i % 3 == 0 ? PrimitiveKind::triangle : s.primitive; // so that slots do not all start at 0
        description.objects.push_back(random_object(kind, s.placing, random.point(3), random));
    }
    const SceneArrays scene = flatten(description, RenderSettings{}, 1);
    Rays rays; // aimed at no edge, which are N2's
    for (std::uint64_t i = 0; i < block.rays; ++i) rays.add(random.point(2), random.direction());
    const Hits hits = ask(*s.kernels, view(scene), rays, s.path);
    const Hits truth = ask(find_kernels("scalar", Precision::reference), view(scene), rays, Path::batch);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const int found = object_of(scene, hits.slot[i]), right = object_of(scene, truth.slot[i]);
        if (found != right && !is_answer(view(scene), rays.o(i), rays.d(i), 16, found, hits.t[i]))
            tally.fail("ray " + std::to_string(i) + ": object " + std::to_string(found) + " instead of " + std::to_string(right));
    }
    tally.rays += rays.size();
}

namespace {

enum class Remedy { none, short_start, own_triangle_left_out };

struct Start {
    std::int32_t slot;
    glm::dvec3 point, normal; ///< outwards
};

glm::dvec3 normal_at(const SceneArrays& scene, std::uint32_t slot, const glm::dvec3& p) {
    if (slot >= scene.first_slot[1]) {
        const SphereRecord& sphere = scene.spheres[slot - scene.first_slot[1]];
        return glm::normalize(p - glm::dvec3(sphere.centre[0], sphere.centre[1], sphere.centre[2]));
    }
    const glm::dvec3 a = corner(scene, slot, 0);
    return glm::normalize(glm::cross(corner(scene, slot, 1) - a, corner(scene, slot, 2) - a));
}

/// Where rays from outside meet the body: org + t * dir, as the caller of a library has it.
std::vector<Start> find_starts(const Block& block, const SceneArrays& scene, Random& random) {
    Rays rays;
    glm::dvec3 from(0);
    for (std::uint64_t i = 0; i < block.rays; ++i) {
        if (i % 64 == 0) from = random.direction() * random.uniform(1.5, 5);
        rays.add(from, glm::normalize(random.point(0.5) - from));
    }
    const Hits hits = ask(*block.setting.kernels, view(scene), rays, block.setting.path);
    std::vector<Start> starts;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits.slot[i] < 0) continue;
        const glm::dvec3 p = rays.o(i) + rays.d(i) * double{hits.t[i]};
        const glm::dvec3 n = normal_at(scene, static_cast<std::uint32_t>(hits.slot[i]), p);
        starts.push_back({hits.slot[i], p, glm::dot(n, rays.d(i)) < 0 ? n : -n});
    }
    return starts;
}

/// Half of them anywhere, half of them grazing.
glm::dvec3 outwards(const glm::dvec3& normal, Random& random) {
    const glm::dvec3 way = random.direction();
    if (random.chance(0.5)) return glm::dot(way, normal) > 0 ? way : -way;
    const double cosine = random.magnitude(1e-4, 1e-1);
    const glm::dvec3 along = glm::normalize(way - normal * glm::dot(way, normal));
    return along * std::sqrt(1 - cosine * cosine) + normal * cosine;
}

/// A convex body alone, of size about 1: what rays that leave it outwards meet is the body itself.
void start_on_body(const Block& block, Remedy remedy, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    SceneDescription description;
    const Shape shape = s.primitive == PrimitiveKind::sphere ? Shape(Sphere{1, {0, 0, 0}}) : Shape(closed_mesh(Form::ball, 24));
    add_object(description, shape, random_placing(s.placing, random));
    const SceneArrays scene = flatten(description, RenderSettings{}, 1);
    const std::vector<Start> starts = find_starts(block, scene, random);
    Rays rays;
    for (const Start& start : starts) {
        rays.add(start.point, outwards(start.normal, random));
        rays.add_range(remedy == Remedy::short_start ? 1e-3f : 0, std::numeric_limits<float>::infinity());
    }
    Hits hits = ask(*s.kernels, view(scene), rays, s.path);
    if (remedy == Remedy::own_triangle_left_out) { // as a filter that refuses it would: the search goes on behind it
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (hits.slot[i] == starts[i].slot) rays.tmin[i] = std::nextafter(hits.t[i], 1e30f);
        hits = ask(*s.kernels, view(scene), rays, s.path);
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (hits.slot[i] >= 0 && (remedy != Remedy::own_triangle_left_out || hits.slot[i] != starts[i].slot))
            tally.fail("ray " + std::to_string(i) + " at t = " + std::to_string(hits.t[i]));
    tally.rays += rays.size();
}

} // namespace

void test_scaled_streams(const Block& block, Tally& tally) { compare_scales(block, 20, tally); }
void test_far_scaled_streams(const Block& block, Tally& tally) { compare_scales(block, 36, tally); }
void test_started_rays(const Block& block, Tally& tally) { start_on_body(block, Remedy::none, tally); }
void test_shortened_rays(const Block& block, Tally& tally) { start_on_body(block, Remedy::short_start, tally); }
void test_filtered_rays(const Block& block, Tally& tally) { start_on_body(block, Remedy::own_triangle_left_out, tally); }

} // namespace lanecast::selftest
