// N3, N4: what a ray hits depends on the ray and the scene alone: not on the tree, the rays beside it, nor the instruction set.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/scenes.hpp"
#include "render/dispatch.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cstring>

namespace lanecast::selftest {
namespace {

/// A scene of the block's setting.
SceneArrays make_scene(const Setting& s, int count, Random& random) {
    const SceneDescription description = random_scene(s.primitive, s.placing, count, random);
    return with_leaves_of(flatten(description, RenderSettings{}, 1), s.leaf_size);
}

/// Runs `attempt(rays)` on the block's rays in pieces, so that it meets several kinds.
template <class Try>
void for_each_piece(const Block& block, const SceneArrays& scene, double farthest, Random& random, Tally& tally, Try&& attempt) {
    constexpr std::uint64_t pieces = 4;
    for (std::uint64_t i = 0; i < pieces; ++i) {
        const std::uint64_t count = block.rays / pieces + (i < block.rays % pieces ? 1 : 0);
        if (count > 0) attempt(random_rays(scene, count, farthest, random));
        tally.rays += count;
    }
}

std::string place(std::size_t ray, const char* what) { return "ray " + std::to_string(ray) + ": " + what; }

bool same(const Hits& a, std::size_t i, const Hits& b, std::size_t k) {
    return a.slot[i] == b.slot[k] && bits_of(a.t[i]) == bits_of(b.t[k]);
}

void compare_with_brute_force(const Block& block, double farthest, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneArrays scene = make_scene(s, 4 + random.below(24), random);
    const SceneView view = lanecast::view(scene);
    for_each_piece(block, scene, farthest, random, tally, [&](Rays rays) {
        if (s.path == Path::mixed) shuffle(rays, random.bits());
        const Hits tree = ask(*s.kernels, view, rays, s.path);
        const Hits all = ask(*s.kernels, view, rays, Path::batch, Query::closest, true);
        const Hits any = ask(*s.kernels, view, rays, s.path, Query::any);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!same(tree, i, all, i))
                tally.fail(place(i, "the tree finds another hit than all primitives"));
            else if ((any.slot[i] >= 0) != (tree.slot[i] >= 0))
                tally.fail(place(i, "any_hit differs from closest_hit"));
        }
    });
}

/// One of those whose bits must be the same; scalar once in 16 times, for it is slow.
const KernelTable& partner_of(const Block& block, Random& random) {
    const KernelTable& own = *block.setting.kernels;
    std::vector<const KernelTable*> partners;
    for (const KernelTable* other : block.kernels)
        if (other != &own && same_numbers(other->precision, own.precision)) partners.push_back(other);
    if (partners.empty()) return own;
    if (partners.front()->width > 1 || random.chance(1.0 / 16) || partners.size() == 1) return *partners.front();
    return *partners[1 + random.bits() % (partners.size() - 1)];
}

/// In pieces of random lengths at odd addresses, with marks behind what may be written.
bool in_pieces(const KernelTable& kernels, const SceneView& scene, const Rays& rays, Random& random, Hits& hits) {
    constexpr std::size_t slack = 40;
    const std::size_t n = rays.size();
    hits.t.assign(n + slack, -7.0f);
    hits.slot.assign(n + slack, -7);
    bool intact = true;
    for (std::size_t begin = 0; begin < n;) {
        const std::size_t count = std::min<std::size_t>(n - begin, 1 + random.bits() % (random.chance(0.5) ? 40 : 3000));
        RayStream stream{};
        for (int axis = 0; axis < 3; ++axis) {
            stream.org[axis] = rays.org[axis].data() + begin;
            stream.dir[axis] = rays.dir[axis].data() + begin;
        }
        if (!rays.tmin.empty()) stream.tmin = rays.tmin.data() + begin, stream.tmax = rays.tmax.data() + begin;
        stream.t = hits.t.data() + begin;
        stream.slot = hits.slot.data() + begin;
        stream.count = static_cast<std::uint32_t>(count);
        stream.coherent = random.chance(0.5) ? 1 : 0;
        kernels.closest_hit(scene, stream);
        begin += count;
        for (std::size_t i = begin; i < begin + slack; ++i) intact = intact && hits.slot[i] == -7 && hits.t[i] == -7.0f;
    }
    return intact;
}

void compare_company(const Block& block, double farthest, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneArrays scene = make_scene(s, 8 + random.below(100), random);
    const SceneView view = lanecast::view(scene);
    const KernelTable& partner = partner_of(block, random);
    for_each_piece(block, scene, farthest, random, tally, [&](const Rays& rays) {
        const Hits first = ask(*s.kernels, view, rays, s.path);
        Rays mixed = rays;
        const std::vector<std::uint32_t> from = shuffle(mixed, random.bits());
        Hits other;
        const bool intact = in_pieces(partner, view, mixed, random, other);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (!same(first, from[i], other, i))
                tally.fail(place(from[i], "another hit in other company, on ") + std::string(partner.isa));
        if (!intact) tally.fail("something was written behind the last ray, on " + std::string(partner.isa));
    });
}

} // namespace

void test_tree_is_brute_force(const Block& block, Tally& tally) { compare_with_brute_force(block, 100, tally); }
void test_tree_from_afar(const Block& block, Tally& tally) { compare_with_brute_force(block, 1e6, tally); }
void test_lanes(const Block& block, Tally& tally) { compare_company(block, 100, tally); }
void test_lanes_from_afar(const Block& block, Tally& tally) { compare_company(block, 1e6, tally); }

} // namespace lanecast::selftest
