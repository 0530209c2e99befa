// The ray tree of a pixel adds up to the pixel.
#include "render/pick.hpp"

#include "render/dispatch.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace lanecast;

namespace {

const std::filesystem::path small_scene = std::filesystem::path(LANECAST_SOURCE_DIR) / "tests/cli/small.json";

struct Setup {
    LoadedScene loaded = load_scene(small_scene);
    RenderSettings settings;
    FrameOptions options{.width = 48, .height = 36};
};

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

const TraceRecord* child_of(const PixelTrace& trace, std::size_t parent, RayKind kind) {
    for (const TraceRecord& ray : trace.rays)
        if (ray.parent == static_cast<std::int32_t>(parent) && ray.kind == kind) return &ray;
    return nullptr;
}

/// The colour of ray i from its parts, as docs/shading.md says it: local + F reflective R, then c (1 - k) + k T.
float rebuilt(const PixelTrace& trace, const SceneArrays& arrays, std::size_t i, int c) {
    const TraceRecord& ray = trace.rays[i];
    const float background = arrays.background[c];
    if (ray.slot < 0) return background;
    float color = ray.ambient[c];
    for (const TraceLight& light : trace.lights)
        if (light.ray == static_cast<std::int32_t>(i)) color += light.color[c];
    const MaterialRecord& material = arrays.materials[arrays.material[static_cast<std::size_t>(ray.slot)]];
    const auto is_zero = [](const float(&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
    if (!is_zero(material.reflective)) {
        const TraceRecord* const child = child_of(trace, i, RayKind::reflection);
        color += material.reflective[c] * ray.fresnel * (child != nullptr ? child->color[c] : background);
    }
    if (!is_zero(material.transmissive)) {
        const TraceRecord* const child = child_of(trace, i, RayKind::refraction);
        const float k = material.transmissive[c];
        color = color * (1.0f - k) + k * (child != nullptr ? child->color[c] : background);
    }
    return color;
}

/// The largest error of a rebuilt colour; and the root's colour is the pixel's, bit for bit.
double check_frame(const Setup& setup, const KernelTable& kernels) {
    const SceneArrays arrays = flatten(setup.loaded.description, setup.settings, 1);
    const Camera& camera = setup.loaded.description.camera;
    const Frame frame = render_frame(kernels, arrays, camera, setup.settings, setup.options);
    double worst = 0;
    int different = 0, deepest = 0;
    for (int y = 0; y < setup.options.height; ++y)
        for (int x = 0; x < setup.options.width; ++x) {
            const PixelTrace trace = trace_pixel(kernels, arrays, camera, setup.settings, setup.options, x, y);
            REQUIRE(!trace.rays.empty());
            for (int c = 0; c < 3; ++c) {
                const float pixel =
                    frame.film.rgb[static_cast<std::size_t>(c)][static_cast<std::size_t>(y * setup.options.width + x)];
                different +=
                    !same_bits(trace.color[static_cast<std::size_t>(c)], pixel) || !same_bits(trace.rays[0].color[c], pixel);
            }
            for (std::size_t i = 0; i < trace.rays.size(); ++i) {
                const TraceRecord& ray = trace.rays[i];
                deepest = std::max(deepest, ray.level);
                CHECK(ray.parent < static_cast<std::int32_t>(i));
                if (i > 0) CHECK(ray.level == trace.rays[static_cast<std::size_t>(ray.parent)].level + 1);
                for (int c = 0; c < 3; ++c)
                    worst = std::max(
                        worst, std::abs(static_cast<double>(ray.color[c]) - static_cast<double>(rebuilt(trace, arrays, i, c))));
            }
        }
    CHECK(different == 0);
    CHECK(deepest == setup.settings.depth);
    return worst;
}

} // namespace

TEST_CASE("the root is the pixel, and every ray is the sum of its parts, bit for bit, on every instruction set") {
    Setup setup;
    setup.settings.depth = 4;
    for (const IsaInfo& isa : known_isas()) {
        if (!isa.compiled || !isa.supported) continue;
        CAPTURE(isa.name);
        CHECK(check_frame(setup, find_kernels(isa.name, Precision::balanced)) == 0);
    }
    setup.settings.schlick = true;
    setup.settings.transmissive_shadows = true;
    setup.settings.soft_shadows = 3;
    CHECK(check_frame(setup, find_kernels("auto", Precision::balanced)) == 0);
    CHECK(check_frame(setup, find_kernels("scalar", Precision::reference)) < 1e-6); // recorded in float
}

TEST_CASE("an unlit scene: local light is the whole colour") {
    Setup setup;
    setup.settings.reflections = setup.settings.transmission = false;
    setup.settings.depth = 0;
    CHECK(check_frame(setup, find_kernels("auto", Precision::balanced)) == 0);
}

TEST_CASE("a tree that outgrows the first guess is traced again, whole") {
    // Two facing mirrors of glass: each hit has two children.
    const char* const text =
        R"({"camera": {"resolution": [8, 8]}, "lights": [{"type": "point", "color": [1, 1, 1], "position": [0, 0, 0]}],
      "objects": [{"type": "sphere", "radius": 4, "position": [0, 0, 0],
        "material": {"diffuse": [1, 1, 1], "reflective": [0.5, 0.5, 0.5], "transmissive": [0.5, 0.5, 0.5], "refraction": 1}},
        {"type": "sphere", "radius": 8, "position": [0, 0, 0],
        "material": {"diffuse": [1, 1, 1], "reflective": [0.5, 0.5, 0.5], "transmissive": [0.5, 0.5, 0.5], "refraction": 1}}]})";
    const LoadedScene loaded = parse_scene(text, "mirrors", ".");
    RenderSettings settings;
    settings.depth = 11;
    const SceneArrays arrays = flatten(loaded.description, settings, 1);
    const KernelTable& kernels = find_kernels("auto", Precision::balanced);
    const FrameOptions options{.width = 8, .height = 8};
    const PixelTrace trace = trace_pixel(kernels, arrays, loaded.description.camera, settings, options, 3, 3);
    CHECK(trace.rays.size() > 256);
    const Frame frame = render_frame(kernels, arrays, loaded.description.camera, settings, options);
    std::size_t expected = 0; // one of the 64 pixels: all are alike, but for the shadow rays
    for (const RayKind kind : {RayKind::primary, RayKind::reflection, RayKind::refraction})
        expected += frame.stats.tiles.kinds[static_cast<int>(kind)].rays;
    CHECK(64 * trace.rays.size() == expected);
    for (std::size_t i = 1; i < trace.rays.size(); ++i) CHECK(trace.rays[i].parent >= 0);
    for (std::size_t c = 0; c < 3; ++c) CHECK(same_bits(trace.rays[0].color[c], frame.film.rgb[c][3 * 8 + 3]));
}

TEST_CASE("a frame that is told to stop stops") {
    const Setup setup;
    const SceneArrays arrays = flatten(setup.loaded.description, setup.settings, 1);
    const KernelTable& kernels = find_kernels("auto", Precision::balanced);
    FrameOptions options = setup.options;
    std::atomic<bool> stop{false};
    options.stop = &stop;
    CHECK(render_frame(kernels, arrays, setup.loaded.description.camera, setup.settings, options).complete);
    stop = true;
    const Frame frame = render_frame(kernels, arrays, setup.loaded.description.camera, setup.settings, options);
    CHECK(!frame.complete);
    CHECK(frame.stats.tiles.kinds[0].rays == 0);
}

TEST_CASE("tiles are large where every thread gets enough of them") {
    FrameOptions options;
    const auto size = [&](int width, int height, int threads, Tile crop = {0, 0, 0, 0}) {
        options.width = width, options.height = height, options.threads = threads, options.crop = crop;
        return default_tile_size(options);
    };
    CHECK(size(512, 512, 2) == 64);
    CHECK(size(512, 512, 4) == 64); // 16 each
    CHECK(size(512, 512, 5) == 32);
    CHECK(size(64, 64, 1) == 32);
    CHECK(size(4096, 4096, 2, {0, 0, 64, 64}) == 32);
    CHECK(size(1920, 1080, 200) == 32);
}
