// Samples of tiles: which tiles, and that their pixels are the frame's.
#include "render/tile_sample.hpp"

#include "render/dispatch.hpp"
#include "render/render_support.hpp"
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
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

TEST_CASE("drawn tiles: each once, the important ones for certain, and the weighted mean is the frame's") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    double bias = 0;
    constexpr int draws = 2000;
    for (int draw = 0; draw < draws; ++draw) {
        const int width = 300 + static_cast<int>(random() % 900), height = 300 + static_cast<int>(random() % 900);
        const TileSample all = each_alone(every_tile(sized(width, height)));
        REQUIRE(all.windows.size() == all.tiles.size());
        const std::size_t tiles = all.tiles.size(), count = 16 + random() % (tiles / 2);
        std::vector<double> importance(tiles), values(tiles);
        double even = 0;
        for (std::size_t i = 0; i < tiles; ++i) {
            even += importance[i] = 0.5 + uniform(random);
            values[i] = uniform(random);
        }
        const std::size_t large = random() % tiles;
        const bool certain = draw % 2 == 0;
        if (certain) importance[large] = even;
        const TileSample drawn = draw_tiles(all, chances_of(importance, count));
        CHECK(drawn.tiles.size() + 1 >= count);
        CHECK(drawn.tiles.size() <= count + 1);
        REQUIRE(drawn.windows.size() == drawn.tiles.size());
        REQUIRE(drawn.weights.size() == drawn.tiles.size());
        std::set<std::pair<int, int>> corners;
        double frame = 0, frame_sum = 0, sum = 0;
        for (std::size_t i = 0; i < tiles; ++i) frame_sum += values[i] * pixels_of(all.tiles[i]);
        for (std::size_t k = 0; k < drawn.tiles.size(); ++k) {
            const Tile& t = drawn.tiles[k];
            corners.insert({t.x0, t.y0});
            CHECK(drawn.window_of[k] == k);
            const auto same = [&](const Tile& other) { return other.x0 == t.x0 && other.y0 == t.y0; };
            const auto i = static_cast<std::size_t>(std::ranges::find_if(all.tiles, same) - all.tiles.begin());
            REQUIRE(i < tiles);
            frame += drawn.weights[k] * pixels_of(t);
            sum += drawn.weights[k] * pixels_of(t) * values[i];
        }
        CHECK(corners.size() == drawn.tiles.size());
        CHECK(frame == doctest::Approx(all.frame_pixels));
        if (certain) CHECK(corners.count({all.tiles[large].x0, all.tiles[large].y0}) == 1);
        bias += (sum / frame_sum - 1) / draws;
    }
    CHECK(std::fabs(bias) < 0.01);
}

TEST_CASE("drawn tiles tell a mean that the importance knows better than evenly spread ones") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(0, 1);
    double drawn_error = 0, spread_error = 0;
    for (int draw = 0; draw < 200; ++draw) {
        const FrameOptions options = sized(1024, 1024);
        const TileSample all = each_alone(every_tile(options));
        std::vector<double> value(all.tiles.size());
        double mean = 0;
        for (double& v : value) mean += v = std::pow(uniform(random), 8);
        mean /= static_cast<double>(value.size());
        std::vector<double> importance = value; // half of it, as errors are only guessed
        for (double& v : importance) v = mean + v * (0.5 + uniform(random));
        const auto relative_error = [&](const TileSample& sample) {
            double sum = 0, weights = 0;
            for (std::size_t k = 0; k < sample.tiles.size(); ++k) {
                const Tile& t = sample.tiles[k];
                sum += sample.weights[k] * value[static_cast<std::size_t>(t.y0 / 32 * 32 + t.x0 / 32)];
                weights += sample.weights[k];
            }
            return std::fabs(sum / weights / mean - 1);
        };
        drawn_error += relative_error(draw_tiles(all, chances_of(importance, 64))) / 200;
        spread_error += relative_error(spread_tiles(options, 64)) / 200;
    }
    CAPTURE(drawn_error);
    CAPTURE(spread_error);
    CHECK(drawn_error < 0.4 * spread_error);
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
            CHECK(rendered.frame_seconds == doctest::Approx(rendered.seconds * sample.frame_pixels / sample.pixels()));
            CHECK(rendered.stats.kinds[0].rays > 0);
            for (const Film& film : rendered.films) CHECK(film_difference(frame.film, film) == "");
        }
    }
}

TEST_CASE("with a stride, every so many-th pixel of each tile is the frame's, and the rest is black") {
    const SceneDescription scene = everything();
    RenderSettings settings = scene.render;
    settings.anti_aliasing.mode = AntiAliasMode::off;
    const SceneArrays arrays = flatten(scene, settings, 2);
    const KernelTable& kernels = find_kernels("auto", Precision::balanced);
    FrameOptions options = sized(97, 40);
    const Frame frame = render_frame(kernels, arrays, scene.camera, settings, options);
    for (const int tile_size : {7, 8, 16})
        for (const int stride : {2, 4}) {
            CAPTURE(tile_size);
            CAPTURE(stride);
            options.tile_size = tile_size;
            TileSample sample = each_alone(every_tile(options));
            sample.stride = stride;
            const RenderedSample rendered = render_sample(kernels, arrays, scene.camera, settings, options, sample);
            std::uint64_t pixels = 0, wrong = 0;
            for (const Film& film : rendered.films)
                for (std::size_t c = 0; c < 3; ++c)
                    for (int y = 0; y < film.height; ++y)
                        for (int x = 0; x < film.width; ++x) {
                            const bool wanted = x % stride == 0 && y % stride == 0;
                            pixels += wanted && c == 0 ? 1 : 0;
                            const auto of_frame = static_cast<std::size_t>((film.y0 + y) * 97 + film.x0 + x);
                            const float value = film.rgb[c][static_cast<std::size_t>(y * film.width + x)];
                            wrong += value == (wanted ? frame.film.rgb[c][of_frame] : 0.0f) ? 0 : 1;
                        }
            CHECK(wrong == 0);
            CHECK(rendered.stats.kinds[0].rays == pixels);
        }
}
