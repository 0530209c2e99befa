#pragma once
// Rays of a Standard Procedural Database counted as their published tests count them, which is not how the renderer traces:
// corner samples, one-sided polygons, a mirror ray off everything that shines or is clear, a tree of five levels.

#include "render/kernel_table.hpp"
#include "scene/description.hpp"

#include <cstdint>

namespace lanecast::test {

/// Which side of a surface must face a light to be worth a shadow ray. The published tests differ in this, where a ray hits from
/// within.
enum class Facing {
    seen, ///< the side the ray came from: Haines' counts
    front ///< the surface's front, which is its outside: GOLEM's
};

struct SpdRules {
    int corners = 513;     ///< a side
    int levels = 5;        ///< of the tree of rays, the eye's being the first
    bool one_sided = true; ///< opaque polygons are passed from behind
    Facing facing = Facing::front;
};

struct SpdCounts {
    std::uint64_t eye = 0, eye_hits = 0;
    std::uint64_t shadow = 0, blocked = 0; ///< rays to a light that the surface faces, and those with anything in their way
    std::uint64_t reflected = 0, refracted = 0;
    std::uint64_t secondary_hits = 0;
    [[nodiscard]] std::uint64_t secondary() const { return reflected + refracted; }
    [[nodiscard]] std::uint64_t all() const { return eye + shadow + secondary(); }
};

/// Through `closest_hit` of the kernels alone.
[[nodiscard]] SpdCounts count_spd_rays(const SceneDescription& scene, const SpdRules& rules, const KernelTable& kernels);

} // namespace lanecast::test
