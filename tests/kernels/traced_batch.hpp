#pragma once
// A batch of rays with memory, for tests that trace with the kernels of their own ISA.

#include "render/kernels/trace.hpp"

#include <vector>

#include <glm/vec3.hpp>

namespace lanecast::test {

inline constexpr std::uint32_t batch = 512;

template <FloatBatch F>
struct TracedBatch {
    using S = Scalar<F>;
    std::vector<S> memory[7];
    std::vector<std::int32_t> source, slot;
    RayBatch<F> rays{};
    TracedBatch() : source(batch + width<F>, no_source), slot(batch + width<F>) {
        for (auto& m : memory) m.resize(batch + width<F>);
        for (int axis = 0; axis < 3; ++axis) rays.org[axis] = memory[axis].data(), rays.dir[axis] = memory[3 + axis].data();
        rays.t = memory[6].data();
        rays.source = source.data(), rays.slot = slot.data();
        rays.tmin = 0, rays.tmax = no_limit<S>;
    }
    void set(std::uint32_t i, const glm::dvec3& o, const glm::dvec3& d) {
        for (int axis = 0; axis < 3; ++axis) {
            rays.org[axis][i] = static_cast<S>(static_cast<float>(o[axis]));
            rays.dir[axis][i] = static_cast<S>(static_cast<float>(d[axis]));
        }
    }
    [[nodiscard]] glm::dvec3 org(std::uint32_t i) const { return {rays.org[0][i], rays.org[1][i], rays.org[2][i]}; }
    [[nodiscard]] glm::dvec3 dir(std::uint32_t i) const { return {rays.dir[0][i], rays.dir[1][i], rays.dir[2][i]}; }
    template <Query query>
    void trace_in(const SceneView& scene, TraceScratch<F>& scratch) {
        RayKindStats stats{};
        trace<query>(scene, rays, batch, false, scratch, stats);
    }
};

} // namespace lanecast::test
