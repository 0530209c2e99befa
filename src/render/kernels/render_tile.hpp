#pragma once
// A tile of the image: which rays its pixels ask for, and their average.

#include "render/kernels/samples.hpp"

namespace lanecast::inline LANECAST_ISA {

template <FloatBatch F>
TileStats render_tile(const RenderJob& job, const Tile& tile, void* memory) {
    const std::uint64_t begin = ticks();
    const FlushDenormals flush;
    TileStats stats{};
    TileScratch<F> scratch;
    ScratchLayout layout(memory);
    scratch.allocate(layout, job);
    scratch.wavefront.stats = &stats;
    PixelBatch<F>& pixels = scratch.pixels;

    Tile region = tile;
    if (job.anti_alias == AntiAliasKind::edge)
        region = {tile.x0 - edge_border, tile.y0 - edge_border, tile.x1 + edge_border, tile.y1 + edge_border};
    list_pixels(pixels, job, region);
    const auto side = static_cast<std::uint32_t>(job.samples);
    if (job.anti_alias == AntiAliasKind::grid) {
        choose_all(pixels);
        clear<F>(pixels.count, pixels.sum);
        add_samples(scratch, {SampleSet::grid, side, 0, RayKind::primary}, pixels.sum);
        write_chosen(job.film, tile, pixels, pixels.sum, side * side);
    } else {
        trace_centres(scratch);
        write_all(job.film, tile, pixels);
    }
    if (job.anti_alias == AntiAliasKind::cross) {
        choose_hits(job, pixels);
        add_samples(scratch, {SampleSet::cross, 0, job.offset, RayKind::offset}, pixels.sum);
        write_chosen(job.film, tile, pixels, pixels.sum, 5);
    } else if (job.anti_alias == AntiAliasKind::edge) {
        refine_edges(scratch, region, tile);
    }
    stats.total_ticks = ticks() - begin;
    return stats;
}

} // namespace lanecast::inline LANECAST_ISA
