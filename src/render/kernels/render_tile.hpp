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
    if (job.anti_alias == AntiAliasKind::edge) { // the neighbours that decide at the tile's border
        region.x0 -= tile.x0 > 0 ? 1 : 0;
        region.y0 -= tile.y0 > 0 ? 1 : 0;
        region.x1 += tile.x1 < job.image_width ? 1 : 0;
        region.y1 += tile.y1 < job.image_height ? 1 : 0;
    }
    list_pixels(pixels, job, region);
    const auto side = static_cast<std::uint32_t>(job.samples);
    if (job.anti_alias == AntiAliasKind::grid) {
        choose_all(pixels);
        clear<F>(pixels.count, pixels.sum);
        trace_samples(scratch, {side * side, side, 0, RayKind::primary}, pixels.sum);
        write_chosen(job.film, tile, pixels, pixels.sum, side * side);
    } else {
        trace_centres(scratch);
        write_all(job.film, tile, pixels);
    }
    if (job.anti_alias == AntiAliasKind::cross) {
        choose_hits(job, pixels);
        trace_samples(scratch, {4, 0, job.offset, RayKind::offset, 1}, pixels.sum);
        write_chosen(job.film, tile, pixels, pixels.sum, 5);
    } else if (job.anti_alias == AntiAliasKind::edge) {
        choose_edges(job.scene, pixels, region, tile);
        clear<F>(pixels.count, pixels.refined);
        trace_samples(scratch, {side * side, side, 0, RayKind::offset}, pixels.refined);
        write_chosen(job.film, tile, pixels, pixels.refined, side * side);
    }
    stats.total_ticks = ticks() - begin;
    return stats;
}

} // namespace lanecast::inline LANECAST_ISA
