// One compilation of this file per instruction set and precision (docs/building.md).

#include "render/kernels/render_tile.hpp"
#include "render/kernels/stream.hpp"

namespace lanecast::inline LANECAST_ISA {

namespace {

using Float = NativeFloat;

constexpr Precision precision = LANECAST_REFERENCE ? Precision::reference
                                : LANECAST_PRECISE ? Precision::precise
                                : LANECAST_FAST    ? Precision::fast
                                                   : Precision::balanced;

std::uint64_t scratch_bytes(const RenderJob& job) noexcept {
    TileScratch<Float> scratch;
    ScratchLayout layout(nullptr);
    scratch.allocate(layout, job);
    return layout.used();
}

TileStats render(const RenderJob& job, Tile tile, void* scratch) noexcept { return render_tile<Float>(job, tile, scratch); }

void closest_hit(const SceneView& scene, const RayStream& rays) noexcept { trace_stream<Query::closest, Float>(scene, rays); }

void any_hit(const SceneView& scene, const RayStream& rays) noexcept { trace_stream<Query::any, Float>(scene, rays); }

} // namespace

extern constinit const KernelTable kernels;
constinit const KernelTable kernels{isa_name, width<Float>, precision, scratch_bytes, render, closest_hit, any_hit};

} // namespace lanecast::inline LANECAST_ISA
