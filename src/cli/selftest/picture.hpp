#pragma once
// Small pictures by one thread: blocks of a run are what threads share.

#include "cli/selftest/random.hpp"
#include "cli/selftest/rays.hpp"
#include "render/renderer.hpp"

namespace lanecast::selftest {

struct Picture {
    Film film;
    TileStats stats; ///< summed over tiles
    [[nodiscard]] std::uint64_t rays() const { return ray_count(stats); }
};

[[nodiscard]] Picture render(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera,
                             const RenderSettings& settings, int width, int height, int tile_size = 32);

/// Runs `body(random)`, which returns how many rays it traced, until they are as many as the block asks for.
template <class Body>
void for_each_picture(const Block& block, Tally& tally, Body&& body) {
    Random random(block.seed);
    const std::uint64_t end = tally.rays + block.rays;
    while (tally.rays < end) tally.rays += body(random);
}

/// Pixels of which a channel differs in its bits; `first`: one of them.
[[nodiscard]] std::uint64_t differing_pixels(const Film& a, const Film& b, std::size_t& first);

} // namespace lanecast::selftest
