// The table of one instruction set. Compiled once per ISA, with LANECAST_ISA its namespace: see cmake/isas.cmake.

#include "render/kernel_table.hpp"

#include <cstdint>

namespace lanecast::inline LANECAST_ISA {
namespace {

#define LANECAST_STRING2(x) #x
#define LANECAST_STRING(x) LANECAST_STRING2(x)

constexpr bool is_isa(const char* name) {
    const char* isa = LANECAST_STRING(LANECAST_ISA);
    while (*isa && *isa == *name) ++isa, ++name;
    return *isa == *name;
}
constexpr bool is_reference = is_isa("reference");

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

extern constinit const KernelTable kernels = {
    is_isa("sse42") ? "sse4.2"
    : is_reference  ? "scalar"
                    : LANECAST_STRING(LANECAST_ISA),
    is_isa("avx512")  ? 16
    : is_isa("avx2")  ? 8
    : is_isa("sse42") ? 4
                      : 1,
    is_reference ? 1u : 0u,
    scratch_bytes,
    render_tile,
    closest_hit,
    any_hit,
};

} // namespace lanecast::inline LANECAST_ISA
