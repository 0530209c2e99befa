#include "cli/measure/sampling.hpp"

#include "render/compare.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lanecast::trade {
namespace {

constexpr double looks_share = 0.2;        ///< of the time that is granted, for the pictures that tell where to look
constexpr double dearer = 2;               ///< than granted: what a sample may be that lies where errors are
constexpr int widest_stride = 4;           ///< of these pictures
constexpr double most_looked_at = 1 << 24; ///< pixels: 200 MB a picture

/// Found on a few scattered pixels, and on more until the clock has something to measure.
[[nodiscard]] double seconds_of_pixel(Bench bench, const Choice& choice) {
    constexpr double enough_seconds = 0.1;
    constexpr std::size_t most_places = 256;
    bench.options.tile_size = 2;
    for (std::size_t places = 64;; places *= 2) {
        bench.sample = spread_tiles(bench.options, places);
        const double seconds = render_sooner(bench, choice.settings).seconds;
        if (seconds > enough_seconds || places >= most_places || bench.sample.windows.size() == 1)
            return seconds / bench.sample.pixels();
    }
}

/// Spread over the frame. `pixels`: as many as can be afforded.
[[nodiscard]] TileSample even_sample(FrameOptions options, double pixels, const SampleLimits& limits) {
    const auto affordable = [&](int tile_size) {
        options.tile_size = tile_size;
        return static_cast<std::size_t>(std::min(pixels / (tile_size * tile_size), static_cast<double>(limits.most_tiles)));
    };
    if (const std::size_t tiles = affordable(16); tiles >= limits.least_tiles) return spread_tiles(options, tiles);
    return spread_tiles(options, std::max(affordable(8), limits.least_tiles / 4));
}

/// Cheap pictures that differ in one knob alone.
struct Look {
    Choice truth;
    std::vector<Choice> coarse;
};

/// What shadow rays leave out is seen without mirrors and glass.
[[nodiscard]] std::vector<Look> looks_of(const Choice& truth, const std::vector<Ladder>& ladders) {
    constexpr int many_shadow_rays = 64;
    const Choice plain{bare(truth.settings), truth.float_file};
    std::vector<Look> looks{{plain, {}}}; // alone, it tells edges
    for (const Ladder& ladder : ladders) {
        Look look{plain, {}};
        if (ladder.knob == Knob::soft_shadows) {
            ladder.alone.set(look.truth);
            look.truth.settings.soft_shadows = std::min(look.truth.settings.soft_shadows, many_shadow_rays);
            look.truth.settings.depth = 0;
        } else if (ladder.knob != Knob::depth && ladder.knob != Knob::cutoff) {
            continue;
        }
        for (const std::size_t i : {std::size_t{0}, ladder.values.size() / 2}) {
            look.coarse.push_back(look.truth);
            ladder.values[i].set(look.coarse.back());
        }
        looks.push_back(look);
    }
    return looks;
}

/// Root of the mean square of differences between neighbours of the pixels that were rendered.
[[nodiscard]] double contrast(const Film& film, int stride) {
    double squares = 0;
    for (const auto& plane : film.rgb)
        for (int y = 0; y < film.height; y += stride)
            for (int x = 0; x < film.width; x += stride) {
                const auto at = [&](int u, int v) { return double{plane[static_cast<std::size_t>(v) * film.width + u]}; };
                const double right = x + stride >= film.width ? 0 : at(x + stride, y) - at(x, y);
                const double below = y + stride >= film.height ? 0 : at(x, y + stride) - at(x, y);
                squares += right * right + below * below;
            }
    return std::sqrt(squares / (3.0 * film.width * film.height));
}

struct Seen {
    std::vector<double> importance; ///< by tile: half of it even, half of it shared by all that the looks show, whatever the unit
    std::vector<double> rays;       ///< by tile, of the first look
};

[[nodiscard]] Seen seen_by(const Bench& bench, const std::vector<Look>& looks, const std::function<double(double r)>& badness) {
    const std::size_t tiles = bench.sample.tiles.size();
    Seen seen;
    std::vector<std::vector<double>> kinds; // each of sum 1
    const auto add_kind = [&](const auto& rmse_of) {
        std::vector<double> kind(tiles);
        for (std::size_t i = 0; i < tiles; ++i) kind[i] = badness(rmse_of(i));
        const double sum = std::accumulate(kind.begin(), kind.end(), 0.0);
        if (!(sum > 0 && std::isfinite(sum))) return;
        for (double& v : kind) v /= sum;
        kinds.push_back(std::move(kind));
    };
    for (const Look& look : looks) {
        const RenderedSample rendered = render(bench, look.truth.settings);
        const std::vector<Film>& truth = rendered.films;
        if (seen.rays.empty()) seen.rays = rendered.tile_rays;
        if (look.coarse.empty()) add_kind([&](std::size_t i) { return contrast(truth[i], bench.sample.stride); });
        for (const Choice& choice : look.coarse) {
            const std::vector<Film> coarse = render(bench, choice.settings).films;
            add_kind([&](std::size_t i) { return compare(coarse[i], truth[i]).rmse; });
        }
    }
    seen.importance.assign(tiles, 1 / static_cast<double>(tiles));
    for (std::size_t i = 0; i < tiles; ++i)
        for (const std::vector<double>& kind : kinds) seen.importance[i] += kind[i] / static_cast<double>(kinds.size());
    return seen;
}

/// Rays of a sample that is drawn with these chances.
[[nodiscard]] double rays_of(const Seen& seen, const std::vector<double>& chances) {
    return std::inner_product(chances.begin(), chances.end(), seen.rays.begin(), 0.0);
}

/// As many as were to be spread evenly. But where errors are, a pixel may take thousands of rays: if that is dear, of smaller
/// tiles no more than can be had. `most_rays`: as many as the pixels of the frame that can be afforded.
[[nodiscard]] TileSample affordable_draw(const TileSample& all, const Seen& seen, std::size_t even_tiles, double most_rays,
                                         const SampleLimits& limits) {
    constexpr int small_tile = 4;
    std::vector<double> chances = chances_of(seen.importance, even_tiles);
    if (rays_of(seen, chances) <= most_rays) return draw_tiles(all, chances);
    TileSample smaller = in_tiles_of(all, small_tile);
    Seen parts;
    for (std::size_t i = 0; i < smaller.tiles.size(); ++i) {
        const std::size_t whole = smaller.window_of[i];
        const double share = pixels_of(smaller.tiles[i]) / pixels_of(all.tiles[whole]);
        parts.importance.push_back(share * seen.importance[whole]);
        parts.rays.push_back(share * seen.rays[whole]);
    }
    for (std::size_t count = limits.most_tiles;; count -= 1 + count / 16) {
        chances = chances_of(parts.importance, count);
        if (rays_of(parts, chances) <= most_rays || count <= limits.least_tiles / 4) return draw_tiles(smaller, chances);
    }
}

} // namespace

TileSample sample_to_look_at(const FrameOptions& options, double pixels) {
    const TileSample all = every_tile(options);
    const double tile_pixels = static_cast<double>(options.tile_size) * options.tile_size;
    const double most = std::min(most_looked_at / tile_pixels, static_cast<double>(all.tiles.size()));
    const auto tiles_at = [&](int stride) { return pixels * stride * stride / tile_pixels; };
    int stride = 1;
    while (stride < widest_stride && tiles_at(stride) < most) stride *= 2;
    const double least = std::min(most, static_cast<double>(tiles_surely_looked_at));
    TileSample sample = each_alone(spread_tiles(options, static_cast<std::size_t>(std::clamp(tiles_at(stride), least, most))));
    sample.stride = stride;
    return sample;
}

TileSample affordable_sample(const Bench& bench, const std::vector<Choice>& pictures, const Choice& truth,
                             const std::vector<Ladder>& ladders, const SampleLimits& limits,
                             const std::function<double(double rmse)>& badness) {
    const double thread_seconds = limits.seconds * bench.options.threads;
    double seconds = 0; // of one pixel of all pictures
    for (const Choice& picture : pictures) seconds += seconds_of_pixel(bench, picture);
    const double affordable_pixels = thread_seconds / seconds;
    const TileSample even = even_sample(bench.options, affordable_pixels, limits);
    if (even.windows.size() == 1) return even;
    const std::vector<Look> looks = looks_of(truth, ladders);
    seconds = 0;
    for (const Look& look : looks) seconds += static_cast<double>(1 + look.coarse.size()) * seconds_of_pixel(bench, look.truth);
    Bench wide = bench;
    wide.options.tile_size = even.tile_size;
    wide.sample = sample_to_look_at(wide.options, looks_share * thread_seconds / seconds);
    const Seen seen = seen_by(wide, looks, badness);
    const double rays = std::reduce(seen.rays.begin(), seen.rays.end()) / wide.sample.pixels();
    return affordable_draw(wide.sample, seen, even.tiles.size(), dearer * rays * std::max(affordable_pixels, even.pixels()),
                           limits);
}

} // namespace lanecast::trade
