// "Same bytes": the film of given settings is one, whatever the instruction set, threads, tiles, crop, tree or unit of length.

#include "cli/selftest/scenes.hpp"
#include "render/render_support.hpp"

#include <doctest/doctest.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

/// Settings that between them use every switch that has an arithmetic of its own.
std::vector<RenderSettings> settings_to_try() {
    std::vector<RenderSettings> result;
    for (const AntiAliasing& aa : anti_aliasings()) {
        RenderSettings s;
        s.anti_aliasing = aa;
        s.depth = 4;
        result.push_back(s);
    }
    result[1].soft_shadows = 3;
    result[2].transmissive_shadows = true;
    result[3].schlick = true;
    result[4].soft_shadows = 2, result[4].transmissive_shadows = true;
    result[5].soft_shadows = 2;
    RenderSettings cut;
    cut.depth = 12;
    cut.cutoff = 0.05;
    cut.schlick = true;
    result.push_back(cut);
    return result;
}

/// The scenes of the promises: everything, and some at random.
std::vector<SceneDescription> scenes_to_try() {
    std::vector<SceneDescription> scenes{everything()};
    Random random(1);
    for (int i = 0; i < 2; ++i) scenes.push_back(random_lit_scene(random, 14));
    return scenes;
}

std::string describe(const RenderSettings& settings) {
    return std::string("anti-aliasing ") + name_of(settings.anti_aliasing.mode) + " soft " +
           std::to_string(settings.soft_shadows) + " transmissive " + std::to_string(settings.transmissive_shadows) +
           " schlick " + std::to_string(settings.schlick);
}

template <class Body>
void for_each_shot(Body&& body) {
    int n = 0;
    for (const SceneDescription& scene : scenes_to_try())
        for (const RenderSettings& settings : settings_to_try()) {
            if (++n % fewer != 0) continue;
            CAPTURE(describe(settings));
            body(scene, Shot{{64, 48, {0, 0, 0, 0}, 1, 32}, settings});
        }
}
/// `fast` promises the same but for other instruction sets, `precise` all of it; they take turns.
template <class Body>
void for_each_other_shot(Body&& body) {
    std::vector<const KernelTable*> tables = usable_kernels(Precision::precise);
    for (const KernelTable* fast : fast_kernels()) tables.push_back(fast);
    std::size_t n = 0;
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) {
        if (tables.empty()) return;
        const KernelTable& kernels = *tables[n++ % tables.size()];
        const std::string on = kernels.isa + std::string(" ") + name_of(kernels.precision);
        CAPTURE(on);
        body(kernels, scene, shot);
    });
}
/// The reference is slow and shares the code: the first scene does.
template <class Body>
void for_each_reference_shot(Body&& body) {
    for (const RenderSettings& settings : settings_to_try()) {
        CAPTURE(describe(settings));
        body(everything(), Shot{{32, 24, {0, 0, 0, 0}, 1, 32}, settings});
        if (fewer > 1) return;
    }
}

} // namespace

TEST_CASE("same bytes on every instruction set") {
    for_each_shot([](const SceneDescription& scene, const Shot& shot) {
        const Frame scalar = shoot(scalar_kernels(), scene, shot);
        for (const KernelTable* kernels : balanced_kernels()) {
            CAPTURE(kernels->isa);
            CHECK(film_difference(scalar.film, shoot(*kernels, scene, shot).film) == "");
        }
    });
}

TEST_CASE("precise: the bytes of the reference on every instruction set") {
    const std::vector<const KernelTable*> tables = usable_kernels(Precision::precise);
    if (tables.empty()) MESSAGE("skipped: no kernels of precision precise in this build or for this CPU");
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) {
        if (tables.empty()) return;
        const Frame scalar = shoot(reference_kernels(), scene, shot);
        for (const KernelTable* kernels : tables) {
            CAPTURE(kernels->isa);
            CHECK(film_difference(scalar.film, shoot(*kernels, scene, shot).film) == "");
        }
    });
}

TEST_CASE("same bytes with any number of threads") {
    const auto check = [](const KernelTable& kernels, const SceneDescription& scene, Shot shot) {
        shot.options.tile_size = 8;
        const Frame one = shoot(kernels, scene, shot);
        for (int threads = 2; threads <= 4; ++threads) {
            shot.options.threads = threads;
            CHECK(film_difference(one.film, shoot(kernels, scene, shot).film) == "");
        }
    };
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) { check(*balanced_kernels().back(), scene, shot); });
    for_each_reference_shot([&](const SceneDescription& scene, const Shot& shot) { check(reference_kernels(), scene, shot); });
    for_each_other_shot(check);
}

TEST_CASE("same bytes with any size of tiles") {
    const auto check = [](const KernelTable& kernels, const SceneDescription& scene, Shot shot) {
        const Frame whole = shoot(kernels, scene, shot);
        for (const int size : {1, 8, 13, 64}) {
            CAPTURE(size);
            shot.options.tile_size = size;
            CHECK(film_difference(whole.film, shoot(kernels, scene, shot).film) == "");
        }
    };
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) { check(*balanced_kernels().back(), scene, shot); });
    for_each_reference_shot([&](const SceneDescription& scene, const Shot& shot) { check(reference_kernels(), scene, shot); });
    for_each_other_shot(check);
}

TEST_CASE("same bytes in any crop, for every anti-aliasing mode") {
    Random random(2);
    const auto check = [&](const KernelTable& kernels, const SceneDescription& scene, Shot shot, int crops) {
        const Frame whole = shoot(kernels, scene, shot);
        const int w = shot.options.width, h = shot.options.height;
        for (int i = 0; i < crops; ++i) {
            const int x0 = random.below(w), y0 = random.below(h);
            shot.options.crop = {x0, y0, x0 + 1 + random.below(w - x0), y0 + 1 + random.below(h - y0)};
            if (i == 0) shot.options.crop = {x0, y0, x0 + 1, y0 + 1};
            CAPTURE(x0 + 1000 * y0);
            const Frame part = shoot(kernels, scene, shot);
            CHECK(part.film.width == shot.options.crop.x1 - x0);
            CHECK(film_difference(whole.film, part.film) == "");
        }
    };
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) { check(*balanced_kernels().back(), scene, shot, 6); });
    for_each_reference_shot([&](const SceneDescription& scene, const Shot& shot) { check(reference_kernels(), scene, shot, 4); });
    for_each_other_shot(
        [&](const KernelTable& kernels, const SceneDescription& scene, const Shot& shot) { check(kernels, scene, shot, 4); });
}

TEST_CASE("same bytes without the tree, and with the one of spatial splits") {
    const auto check = [](const KernelTable& kernels, const SceneDescription& scene, Shot shot) {
        const Frame tree = shoot(kernels, scene, shot);
        for (const BvhMode mode : {BvhMode::off, BvhMode::quality}) {
            shot.settings.bvh = mode;
            CHECK(film_difference(tree.film, shoot(kernels, scene, shot).film) == "");
        }
    };
    for_each_shot([&](const SceneDescription& scene, const Shot& shot) { check(*balanced_kernels().back(), scene, shot); });
    for_each_reference_shot([&](const SceneDescription& scene, const Shot& shot) { check(reference_kernels(), scene, shot); });
    for_each_other_shot(check);
}

TEST_CASE("same bytes where mirrors and glass are split: no part of a triangle hits its own ray") {
    Random random(9);
    for (int n = 0; n < 4; ++n) {
        SceneDescription scene = random_lit_scene(random, 6);
        Object needle = make_object(needles(random, 150));
        needle.transformations = {Scale{{2, 2, 2}}};
        needle.material = scene.objects[0].material;
        needle.material.reflective = glm::dvec3(0.5);
        needle.material.transmissive = glm::dvec3(n % 2 == 0 ? 0.5 : 0.0);
        scene.objects.push_back(needle);
        for (const bool transmissive_shadows : {false, true}) {
            Shot shot{{64, 48, {0, 0, 0, 0}, 1, 32}, {}};
            shot.settings.transmissive_shadows = transmissive_shadows;
            shot.settings.depth = 4;
            const Frame plain = shoot(*balanced_kernels().back(), scene, shot);
            shot.settings.bvh = BvhMode::quality;
            CHECK(film_difference(plain.film, shoot(*balanced_kernels().back(), scene, shot).film) == "");
            shot.settings.bvh = BvhMode::off;
            CHECK(film_difference(plain.film, shoot(*balanced_kernels().back(), scene, shot).film) == "");
        }
    }
}

TEST_CASE("same bytes in any unit of length: every length times 2^k") {
    for_each_shot([](SceneDescription scene, Shot shot) {
        shot.settings.soft_shadows = 2;
        scene.camera.near = 2.5;
        const Frame one = shoot(*balanced_kernels().back(), scene, shot);
        for (const int k : {-40, -7, 1, 23, 40}) {
            CAPTURE(k);
            CHECK(film_difference(one.film, shoot(*balanced_kernels().back(), selftest::scaled_scene(scene, k), shot).film) ==
                  "");
        }
    });
}

TEST_CASE("same bytes when a scene is rendered twice, and different ones when it changes") {
    const Shot shot;
    const Frame a = shoot(*balanced_kernels().back(), everything(), shot),
                b = shoot(*balanced_kernels().back(), everything(), shot);
    CHECK(film_difference(a.film, b.film) == "");
    SceneDescription moved = everything();
    moved.camera.position.x += 1e-3;
    CHECK(film_difference(a.film, shoot(*balanced_kernels().back(), moved, shot).film) != "");
}
