#include "cli/measure/sampling.hpp"

#include <algorithm>

namespace lanecast::trade {
namespace {

/// Found on a few scattered pixels, and on more until the clock has something to measure.
[[nodiscard]] double seconds_of_pixel(Bench bench, const Choice& choice) {
    constexpr double enough_seconds = 0.1;
    constexpr std::size_t most_places = 256;
    bench.options.tile_size = 2;
    for (std::size_t places = 64;; places *= 2) {
        bench.sample = spread_tiles(bench.options, places);
        const double seconds = render(bench, choice.settings).seconds;
        if (seconds > enough_seconds || places >= most_places || bench.sample.windows.size() == 1)
            return seconds / bench.sample.pixels();
    }
}

} // namespace

TileSample affordable_sample(const Bench& bench, const std::vector<Choice>& pictures, const SampleLimits& limits) {
    double seconds = 0;
    for (const Choice& picture : pictures) seconds += seconds_of_pixel(bench, picture);
    FrameOptions options = bench.options;
    const auto affordable = [&](int tile_size) {
        options.tile_size = tile_size;
        const double tiles = limits.seconds / (seconds * tile_size * tile_size);
        return static_cast<std::size_t>(std::min(tiles, static_cast<double>(limits.most_tiles)));
    };
    if (const std::size_t tiles = affordable(16); tiles >= limits.least_tiles) return spread_tiles(options, tiles);
    return spread_tiles(options, std::max(affordable(8), limits.least_tiles / 4));
}

} // namespace lanecast::trade
