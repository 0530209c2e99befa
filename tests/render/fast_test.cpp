// `--precision fast`: what it promises on one instruction set, and how far it is from the reference (docs/numerics.md).

#include "render/render_support.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Into a normalised scene, from within and without: from one point, or from all over; some with a range.
Rays random_rays(Random& random, int n) {
    Rays rays;
    const bool camera = random.chance(0.5), ranged = random.chance(0.3);
    const glm::dvec3 eye = random.point(2);
    for (int i = 0; i < n; ++i) {
        const glm::dvec3 o = camera ? eye : random.point(2);
        const bool near_only = ranged && random.chance(0.5);
        rays.add(o, random.point(0.5) - o);
        rays.add_range(ranged ? static_cast<float>(random.uniform(0, 0.5)) : 0.0f, near_only ? 1.0f : infinity);
    }
    return rays;
}

Rays picked(const Rays& rays, const std::vector<std::size_t>& which) {
    Rays out;
    for (const std::size_t i : which) {
        for (int axis = 0; axis < 3; ++axis) {
            out.org[axis].push_back(rays.org[axis][i]);
            out.dir[axis].push_back(rays.dir[axis][i]);
        }
        out.tmin.push_back(rays.tmin[i]);
        out.tmax.push_back(rays.tmax[i]);
    }
    return out;
}

SceneDescription spheres(Random& random) {
    SceneDescription scene;
    for (int i = 0; i < 60; ++i) scene.objects.push_back(make_object(Sphere{random.uniform(0.02, 0.4), random.point(1)}));
    return scene;
}
SceneDescription quadrics(Random& random) {
    SceneDescription scene;
    for (int i = 0; i < 60; ++i) {
        const Shape shapes[] = {Sphere{}, Cylinder{}, Cylinder{1, 1, false}, Cone{}, Cone{1, 0.5, 1, false}};
        const auto stretch = [&] { return std::exp(random.uniform(-3.5, -1)); };
        scene.objects.push_back(make_object(shapes[random.below(5)], {Scale{{stretch(), stretch(), stretch()}},
                                                                      Rotation{random.direction(), random.uniform(0, 360)},
                                                                      Translation{random.point(1)}}));
    }
    return scene;
}
SceneDescription triangles(Random& random) {
    std::vector<std::array<glm::dvec3, 3>> soup;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p = random.point(1);
        soup.push_back({p, p + random.point(0.2), p + random.point(0.2)});
    }
    SceneDescription scene;
    scene.objects.push_back(make_object(triangle_mesh(soup)));
    return scene;
}

/// Against the reference, whose t is rounded to a float, too.
struct Errors {
    std::uint64_t rays = 0, hits = 0, missed = 0, extra = 0, other = 0;
    std::vector<double> ulps;

    void add(const Hits& hits_, const Hits& truth) {
        for (std::size_t i = 0; i < truth.slot.size(); ++i) {
            const bool hit = hits_.slot[i] >= 0, meant = truth.slot[i] >= 0;
            ++rays;
            hits += meant;
            missed += meant && !hit;
            extra += hit && !meant;
            if (!hit || !meant) continue;
            const double ulp = std::ldexp(1.0, std::ilogb(truth.t[i]) - 23);
            const double off = std::fabs(double{hits_.t[i]} - double{truth.t[i]}) / ulp;
            if (hits_.slot[i] == truth.slot[i])
                ulps.push_back(off);
            else
                other += off > 4;
        }
    }
    [[nodiscard]] double per_million(std::uint64_t n) const { return 1e6 * static_cast<double>(n) / static_cast<double>(rays); }
    [[nodiscard]] double quantile(double share) {
        const auto at = ulps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(ulps.size() - 1));
        std::nth_element(ulps.begin(), at, ulps.end());
        return *at;
    }
    std::string text() {
        return std::to_string(rays) + " rays, " + std::to_string(hits) + " hits; per million missed " +
               std::to_string(per_million(missed)) + ", false " + std::to_string(per_million(extra)) + ", other primitive " +
               std::to_string(per_million(other)) + "; t in ulp p50 " + std::to_string(quantile(0.5)) + " p99 " +
               std::to_string(quantile(0.99)) + " max " + std::to_string(quantile(1));
    }
};

struct Kind {
    const char* name;
    SceneDescription (*make)(Random&);
    double p99; ///< ulp of t, at most
};
constexpr Kind kinds[] = {{"spheres", spheres, 8}, {"quadrics", quadrics, 64}, {"triangles", triangles, 16}};

} // namespace

TEST_CASE("fast: tree, batch and neighbours change no bit of a ray's answer") {
    if (fast_kernels().empty()) MESSAGE("skipped: no kernels of precision fast in this build or for this CPU");
    Random random(1);
    std::uint64_t hit = 0, rays_in_all = 0;
    for (int n = 0; n < cases(150); ++n) {
        SceneDescription scene = random_scene(random, 1 + random.below(60));
        if (n % 3 == 0) scene.objects.push_back(make_object(needles(random, 100)));
        RenderSettings settings;
        settings.bvh = n % 2 == 0 ? BvhMode::standard : BvhMode::quality;
        const SceneArrays arrays = flatten(scene, settings, 1);
        const Rays rays = random_rays(random, 1 + random.below(2000));
        std::vector<std::size_t> order(rays.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), random.engine);
        order.resize(1 + order.size() / static_cast<std::size_t>(1 + random.below(40)));
        for (const KernelTable* kernels : fast_kernels()) {
            const std::string isa = kernels->isa;
            CAPTURE(isa);
            const Hits alone = ask(*kernels, view(arrays), rays, Query::closest, true);
            const Hits tree = ask(*kernels, view(arrays), rays, Query::closest);
            const Hits few = ask(*kernels, view(arrays), picked(rays, order), Query::closest);
            const Hits shadow = ask(*kernels, view(arrays), picked(rays, order), Query::any);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                REQUIRE(tree.slot[i] == alone.slot[i]);
                REQUIRE(bits_of(tree.t[i]) == bits_of(alone.t[i]));
                hit += alone.slot[i] >= 0;
                ++rays_in_all;
            }
            for (std::size_t i = 0; i < order.size(); ++i) {
                REQUIRE(few.slot[i] == alone.slot[order[i]]);
                REQUIRE(bits_of(few.t[i]) == bits_of(alone.t[order[i]]));
                REQUIRE((shadow.slot[i] >= 0) == (alone.slot[order[i]] >= 0));
            }
        }
    }
    CHECK(hit * 20 >= rays_in_all);
}

TEST_CASE("fast: the same bytes on every instruction set that has it") {
    const std::vector<const KernelTable*> tables = fast_kernels();
    if (tables.size() < 2) {
        MESSAGE("skipped: fewer than two instruction sets with fast");
        return;
    }
    Random random(3);
    for (int n = 0; n < cases(40); ++n) {
        Shot shot;
        shot.settings.schlick = n % 2 == 0;
        shot.settings.soft_shadows = n % 3 == 0 ? 2 : 0;
        shot.settings.depth = 4;
        const SceneDescription scene = n == 0 ? everything() : random_lit_scene(random, 1 + random.below(20));
        const Frame first = shoot(*tables[0], scene, shot);
        for (const KernelTable* kernels : tables) CHECK(film_difference(first.film, shoot(*kernels, scene, shot).film) == "");
    }
    const Frame fast = shoot(*tables[0], everything(), {}), balanced = shoot(scalar_kernels(), everything(), {});
    CHECK(film_difference(fast.film, balanced.film) != "");
}

TEST_CASE("fast: as near to the reference as published") {
    for (const Kind& kind : kinds) {
        const std::string name = kind.name;
        CAPTURE(name);
        const std::vector<const KernelTable*> tables = fast_kernels();
        std::vector<Errors> fast(tables.size());
        Errors balanced;
        Random random(2);
        for (int n = 0; n < cases(100); ++n) {
            const SceneArrays arrays = flatten(kind.make(random), RenderSettings{}, 1);
            const Rays rays = random_rays(random, 10000);
            const Hits truth = ask(reference_kernels(), view(arrays), rays, Query::closest);
            balanced.add(ask(*balanced_kernels().back(), view(arrays), rays, Query::closest), truth);
            for (std::size_t k = 0; k < tables.size(); ++k)
                fast[k].add(ask(*tables[k], view(arrays), rays, Query::closest), truth);
        }
        MESSAGE("balanced: ", balanced.text());
        for (std::size_t k = 0; k < tables.size(); ++k) {
            const std::string isa = tables[k]->isa;
            CAPTURE(isa);
            MESSAGE("fast: ", fast[k].text());
            CHECK(fast[k].hits > fast[k].rays / 10);
            CHECK(fast[k].per_million(fast[k].missed) <= 25);
            CHECK(fast[k].per_million(fast[k].extra) <= 25);
            CHECK(fast[k].per_million(fast[k].other) <= 25);
            CHECK(fast[k].quantile(0.99) <= kind.p99);
        }
    }
}
