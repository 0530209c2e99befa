// Samples of tiles: which tiles, and that their pixels are the frame's.
#include "render/tile_sample.hpp"

#include "render/dispatch.hpp"
#include "render/render_support.hpp"
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <set>

using namespace lanecast;
using namespace lanecast::test;

namespace {

FrameOptions sized(int width, int height, Tile crop = {0, 0, 0, 0}) {
    FrameOptions options;
    options.width = width;
    options.height = height;
    options.crop = crop;
    options.threads = 3;
    return options;
}

} // namespace

TEST_CASE("tiles are spread: each once, in the frame, in every part of it") {
    for (const auto& [width, height, count] : {std::tuple{512, 512, 24}, {1920, 1080, 40}, {333, 77, 5}, {64, 2048, 31}}) {
        const TileSample sample = spread_tiles(sized(width, height), static_cast<std::size_t>(count));
        REQUIRE(sample.tiles.size() == static_cast<std::size_t>(count));
        std::set<std::pair<int, int>> corners;
        int quarters[4] = {};
        for (const Tile& t : sample.tiles) {
            corners.insert({t.x0, t.y0});
            CHECK(t.x0 % 32 == 0);
            CHECK(t.y0 % 32 == 0);
            CHECK(t.x1 == std::min(t.x0 + 32, width));
            CHECK(t.y1 == std::min(t.y0 + 32, height));
            ++quarters[(t.x0 + t.x1 > width ? 1 : 0) + (t.y0 + t.y1 > height ? 2 : 0)];
        }
        CHECK(corners.size() == sample.tiles.size());
        for (const int n : quarters) CHECK(n >= count / 8);
        CHECK(sample.frame_pixels == width * height);
        CHECK(sample.pixels() <= 1024.0 * count);
    }
}

TEST_CASE("as many tiles as there are, or more, are the whole frame in one film") {
    for (const std::size_t count : {6u, 7u, 1000u}) {
        const TileSample sample = spread_tiles(sized(70, 40), count);
        CHECK(sample.tiles.size() == 6);
        CHECK(sample.windows.size() == 1);
        CHECK(sample.pixels() == 70 * 40);
    }
    const TileSample crop = every_tile(sized(70, 40, {10, 5, 50, 35}));
    CHECK(crop.frame_pixels == 40 * 30);
    CHECK(crop.pixels() == 40 * 30);
    CHECK(crop.windows.front().x0 == 10);
}

TEST_CASE("pixels are those of the frame, in every mode of anti-aliasing and in smaller tiles") {
    const SceneDescription scene = everything();
    const KernelTable& kernels = find_kernels("auto", Precision::balanced);
    for (const AntiAliasing& aa : anti_aliasings()) {
        if (fewer > 1 && aa.mode == AntiAliasMode::grid) continue; // sanitizers: the other modes are enough
        RenderSettings settings = scene.render;
        settings.anti_aliasing = aa;
        settings.soft_shadows = 2;
        const SceneArrays arrays = flatten(scene, settings, 2);
        const FrameOptions options = fewer > 1 ? sized(97, 40) : sized(200, 150);
        const Frame frame = render_frame(kernels, arrays, scene.camera, settings, options);
        for (const TileSample& sample : {spread_tiles(options, 7), every_tile(options), in_tiles_of(spread_tiles(options, 7), 5),
                                         in_tiles_of(every_tile(options), 64)}) {
            const RenderedSample rendered = render_sample(kernels, arrays, scene.camera, settings, options, sample);
            CHECK(rendered.seconds > 0);
            CHECK(rendered.stats.kinds[0].rays > 0);
            for (const Film& film : rendered.films) CHECK(film_difference(frame.film, film) == "");
        }
    }
}
