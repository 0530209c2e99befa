#include "cli/selftest/picture.hpp"

namespace lanecast::selftest {

Picture render(const KernelTable& kernels, const SceneArrays& scene, const Camera& camera, const RenderSettings& settings,
               int width, int height, int tile_size) {
    FrameOptions options;
    options.width = width, options.height = height, options.tile_size = tile_size;
    Frame frame = render_frame(kernels, scene, camera, settings, options);
    return {std::move(frame.film), frame.stats.tiles};
}

std::uint64_t differing_pixels(const Film& a, const Film& b, std::size_t& first) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.rgb[0].size(); ++i) {
        bool differs = false;
        for (std::size_t c = 0; c < 3; ++c) differs = differs || bits_of(a.rgb[c][i]) != bits_of(b.rgb[c][i]);
        if (differs && count++ == 0) first = i;
    }
    return count;
}

} // namespace lanecast::selftest
