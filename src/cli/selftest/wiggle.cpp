#include "cli/selftest/wiggle.hpp"

#include "cli/selftest/random.hpp"
#include "render/dispatch.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {

bool is_answer(const SceneView& scene, const glm::dvec3& o, const glm::dvec3& d, double roundings, int object, float t) {
    const double rounding = roundings * 0x1p-24;
    Random random(1);
    Rays rays;
    const double reach = rounding * (glm::length(o) + 1), turn = rounding * glm::length(d);
    rays.add(o, d);
    for (int i = 0; i < 2000; ++i) { // many: of a thin tip few rays are met
        const double share = random.magnitude(0.01, 1);
        rays.add(o + random.point(reach * share), d + random.point(turn * share));
    }
    const Hits hits = ask(find_kernels("auto", Precision::reference), scene, rays, Path::batch);
    double lo = 1e300, hi = -1e300;
    bool found = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::int32_t slot = hits.slot[i];
        if ((slot < 0 ? -1 : static_cast<int>(scene.object[slot])) != object) continue;
        found = true;
        lo = std::min(lo, double{hits.t[i]}), hi = std::max(hi, double{hits.t[i]});
    }
    if (!found || object < 0) return found;
    const double slack = 4 * 0x1p-23 * std::fabs(hi) + (hi - lo);
    return double{t} >= lo - slack && double{t} <= hi + slack;
}

} // namespace lanecast::selftest
