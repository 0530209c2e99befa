// The table of one instruction set. Compiled once per ISA, with LANECAST_ISA its namespace: see cmake/isas.cmake.

#include "render/kernel_table.hpp"

#include <string_view>

namespace lanecast::inline LANECAST_ISA {
namespace {

#define LANECAST_STRING2(x) #x
#define LANECAST_STRING(x) LANECAST_STRING2(x)
constexpr std::string_view isa_name = LANECAST_STRING(LANECAST_ISA);
constexpr std::int32_t isa_width = isa_name == "sse42" ? 4 : isa_name == "avx2" ? 8 : isa_name == "avx512" ? 16 : 1;

std::uint64_t scratch_bytes(const RenderJob&) noexcept { return 0; }

TileStats render_tile(const RenderJob&, Tile, void*) noexcept { return {}; }

// Every ray misses.
void closest_hit(const SceneView&, const RayStream& rays) noexcept {
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        rays.t[i] = rays.tmax ? rays.tmax[i] : __builtin_inff();
        rays.slot[i] = -1;
    }
}

void any_hit(const SceneView&, const RayStream& rays) noexcept {
    for (std::uint32_t i = 0; i < rays.count; ++i) rays.slot[i] = -1;
}

} // namespace

extern constinit const KernelTable kernels = {isa_name == "sse42"       ? "sse4.2"
                                              : isa_name == "reference" ? "scalar"
                                                                        : LANECAST_STRING(LANECAST_ISA),
                                              isa_width,
                                              isa_name == "reference" ? 1u : 0u,
                                              scratch_bytes,
                                              render_tile,
                                              closest_hit,
                                              any_hit};

} // namespace lanecast::inline LANECAST_ISA
