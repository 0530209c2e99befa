// The renderer against an independent tracer: same pictures but where an infinitesimal step of the camera ray changes the oracle
// too.

#include "render/render_support.hpp"
#include "render/whitted_oracle.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lanecast;
using namespace lanecast::test;

namespace {

struct Agreement {
    int pixels = 0, edges = 0, wrong = 0;
    std::vector<double> errors;
    std::string first;
};

double distance(const Film& film, int x, int y, const glm::dvec3& truth) {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        const double value =
            static_cast<double>(film.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>(y * film.width + x)]);
        const double off = std::fabs(value - truth[c]) / (0.1 + std::fabs(truth[c]));
        worst = off > worst || off != off ? off : worst;
    }
    return worst;
}

/// A pixel that differs is an edge when the oracle gives the film's value within `reach` pixels of its centre.
void compare(const Film& film, const WhittedOracle& oracle, double tolerance, double reach, int scene, Agreement& result) {
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x) {
            ++result.pixels;
            const double off = distance(film, x, y, oracle.color_at(x + 0.5, y + 0.5, film.width, film.height));
            if (off <= tolerance) {
                result.errors.push_back(off);
                continue;
            }
            bool edge = false;
            for (double step = reach / 64; step <= reach && !edge; step *= 2)
                for (int k = 0; k < 8 && !edge; ++k) {
                    const double dx = std::cos(0.7853981 * k) * step, dy = std::sin(0.7853981 * k) * step;
                    edge = distance(film, x, y, oracle.color_at(x + 0.5 + dx, y + 0.5 + dy, film.width, film.height)) <=
                           20 * tolerance;
                }
            ++(edge ? result.edges : result.wrong);
            if (!edge && result.first.empty())
                result.first = "scene " + std::to_string(scene) + " pixel " + std::to_string(x) + "," + std::to_string(y) +
                               " off by " + std::to_string(off);
        }
}

struct Variant {
    const char* name;
    std::function<void(RenderSettings&)> set;
};
const std::vector<Variant>& variants() {
    static const std::vector<Variant> all{
        {"plain", [](RenderSettings&) {}},
        {"schlick", [](RenderSettings& s) { s.schlick = true; }},
        {"transmissive shadows", [](RenderSettings& s) { s.transmissive_shadows = true; }},
        {"depth 2", [](RenderSettings& s) { s.depth = 2; }},
        {"no shadows", [](RenderSettings& s) { s.shadows = false; }},
        {"no reflections", [](RenderSettings& s) { s.reflections = false; }},
        {"no transmission", [](RenderSettings& s) { s.transmission = false; }},
        {"no refraction, schlick", [](RenderSettings& s) { s.refraction = false, s.schlick = true; }},
        {"no planes", [](RenderSettings& s) { s.planes = false; }},
        {"no ambient", [](RenderSettings& s) { s.ambient = false; }},
        {"no diffuse", [](RenderSettings& s) { s.diffuse = false; }},
        {"no specular", [](RenderSettings& s) { s.specular = false; }},
    };
    return all;
}

} // namespace

TEST_CASE("the pictures of random scenes are those of an independent tracer") {
    Random random(1);
    Agreement reference, balanced;
    std::uint64_t rays[ray_kind_count] = {};
    for (int n = 0; n < cases(480); ++n) {
        const SceneDescription scene = n == 0 ? everything() : random_lit_scene(random, 1 + random.below(20));
        const Variant& variant = variants()[static_cast<std::size_t>(n) % variants().size()];
        Shot shot{{24, 18, {0, 0, 0, 0}, 1, 32}, {}};
        shot.settings.depth = 5;
        variant.set(shot.settings);
        const WhittedOracle oracle(scene, shot.settings);
        CAPTURE(n);
        CAPTURE(variant.name);
        const int wrong = reference.wrong;
        compare(shoot(reference_kernels(), scene, shot).film, oracle, 1e-4, 0.02, n, reference);
        const Frame frame = shoot(*balanced_kernels().back(), scene, shot);
        compare(frame.film, oracle, 1e-3, 0.05, n, balanced);
        for (int kind = 0; kind < ray_kind_count; ++kind) rays[kind] += frame.stats.tiles.kinds[kind].rays;
        CHECK(reference.wrong - wrong <= 1);
    }
    // the pictures show something; sanitizers see fewer scenes, of another mix
    const std::uint64_t share = cases(480) == 480 ? 1 : 2;
    const auto rays_of = [&](RayKind kind) { return rays[static_cast<int>(kind)]; };
    CHECK(rays_of(RayKind::shadow) > rays_of(RayKind::primary));
    CHECK(share * rays_of(RayKind::reflection) > rays_of(RayKind::primary));
    CHECK(share * rays_of(RayKind::refraction) > rays_of(RayKind::primary));
    MESSAGE(rays_of(RayKind::shadow), " shadow, ", rays_of(RayKind::reflection), " reflected, ", rays_of(RayKind::refraction),
            " transmitted rays");
    const auto report = [](const std::string& name, Agreement& a) {
        std::sort(a.errors.begin(), a.errors.end());
        MESSAGE(name, ": ", a.pixels, " pixels, ", a.edges, " at edges, ", a.wrong, " wrong (", a.first, "), error median ",
                a.errors[a.errors.size() / 2], ", 99 % ", a.errors[a.errors.size() * 99 / 100]);
        CHECK(a.errors[a.errors.size() / 2] < 1e-5);
        CHECK(a.edges < a.pixels / 50);
        CHECK(a.wrong <= a.pixels / 5000);
    };
    report("reference", reference);
    report("balanced", balanced);
}

TEST_CASE("the largest shares and colours overflow to infinities, never to no number") {
    SceneDescription scene;
    scene.camera.background = glm::dvec3(1e30);
    Material glass;
    glass.ambient = glm::dvec3(1e30);
    glass.reflective = glass.transmissive = {1e6, 1, 0.5};
    for (const double x : {-0.5, 0.5}) {
        Object& object = scene.objects.emplace_back();
        object.shape = Sphere{1, {x, 0, 0}};
        object.material = glass;
    }
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1e30)});
    scene.camera.position = {0, 0, 4};
    RenderSettings settings;
    settings.depth = 8;
    const SceneArrays arrays = flatten(scene, settings, 1);
    FrameOptions options;
    options.width = options.height = 16;
    for (const KernelTable* kernels : usable_kernels()) {
        CAPTURE(kernels->isa);
        const Frame frame = render_frame(*kernels, arrays, scene.camera, settings, options);
        for (const auto& plane : frame.film.rgb)
            CHECK(std::ranges::none_of(plane, [](float value) { return std::isnan(value); }));
    }
}
