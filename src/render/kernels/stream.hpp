#pragma once
// The library's entry points: rays of any number and alignment, in batches through the same `trace` as the renderer's.

#include "render/kernel_table.hpp"
#include "render/kernels/trace.hpp"

namespace lanecast::inline LANECAST_ISA {

template <Query query, FloatBatch F>
void trace_stream(const SceneView& scene, const RayStream& stream) {
    using S = Scalar<F>;
    constexpr std::uint32_t chunk = 512;
    constexpr std::uint32_t slack = chunk + width<F>;
    const FlushDenormals flush;
    alignas(64) S floats[9][slack];
    alignas(64) std::int32_t integers[2][slack];
    TraceScratch<F> scratch;
    RayKindStats stats{};
    const RayBatch<F> rays{{floats[0], floats[1], floats[2]},
                           {floats[3], floats[4], floats[5]},
                           integers[0],
                           floats[6],
                           integers[1],
                           S(0),
                           no_limit<S>,
                           stream.tmin != nullptr ? floats[7] : nullptr,
                           stream.tmax != nullptr ? floats[8] : nullptr,
                           nullptr};
    for (std::uint32_t i = 0; i < slack; ++i) integers[0][i] = no_source;
    for (std::uint32_t begin = 0; begin < stream.count; begin += chunk) {
        const std::uint32_t n = stream.count - begin < chunk ? stream.count - begin : chunk;
        for (std::uint32_t i = 0; i < n; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                rays.org[axis][i] = static_cast<S>(stream.org[axis][begin + i]);
                rays.dir[axis][i] = static_cast<S>(stream.dir[axis][begin + i]);
            }
            if (stream.tmin != nullptr) floats[7][i] = static_cast<S>(stream.tmin[begin + i]);
            if (stream.tmax != nullptr) floats[8][i] = min(no_limit<S>, static_cast<S>(stream.tmax[begin + i])); // a NaN stays
        }
        trace<query>(scene, rays, n, stream.brute_force != 0, scratch, stats);
        for (std::uint32_t i = 0; i < n; ++i) {
            stream.slot[begin + i] = rays.slot[i];
            if (query == Query::any) continue;
            const float tmax = stream.tmax != nullptr ? stream.tmax[begin + i] : std::numeric_limits<float>::infinity();
            stream.t[begin + i] = rays.slot[i] < 0 ? tmax : static_cast<float>(rays.t[i]);
        }
    }
}

} // namespace lanecast::inline LANECAST_ISA
