#include "cli/selftest/rays.hpp"

#include "cli/selftest/random.hpp"

#include <cmath>
#include <numeric>

namespace lanecast::selftest {

Hits ask(const KernelTable& kernels, const SceneView& scene, const Rays& rays, Path path, Query query, bool brute_force) {
    Hits hits{std::vector<float>(rays.size(), -7.0f), std::vector<std::int32_t>(rays.size(), -7)};
    const std::size_t piece = path == Path::single ? 1 : rays.size();
    const auto call = query == Query::closest ? kernels.closest_hit : kernels.any_hit;
    for (std::size_t begin = 0; begin < rays.size(); begin += piece) {
        RayStream stream{};
        for (int axis = 0; axis < 3; ++axis) {
            stream.org[axis] = rays.org[axis].data() + begin;
            stream.dir[axis] = rays.dir[axis].data() + begin;
        }
        if (!rays.tmin.empty()) stream.tmin = rays.tmin.data() + begin;
        if (!rays.tmax.empty()) stream.tmax = rays.tmax.data() + begin;
        stream.t = query == Query::closest ? hits.t.data() + begin : nullptr;
        stream.slot = hits.slot.data() + begin;
        stream.brute_force = brute_force ? 1 : 0;
        stream.count = static_cast<std::uint32_t>(piece);
        stream.coherent = path == Path::batch ? 1 : 0;
        call(scene, stream);
    }
    return hits;
}

WorldHits ask_in_world(const KernelTable& kernels, const SceneArrays& scene, const Rays& rays, Path path) {
    const std::size_t n = rays.size();
    WorldHits hits{std::vector<float>(n), {}, std::vector<std::int32_t>(n)};
    for (auto& axis : hits.normal) axis.resize(n);
    StreamUnits units{};
    for (int axis = 0; axis < 3; ++axis) units.centre[axis] = scene.normalisation.centre[axis];
    units.scale = scene.normalisation.scale;
    const std::size_t piece = path == Path::single ? 1 : n;
    for (std::size_t begin = 0; begin < n; begin += piece) {
        RayStream stream{};
        for (int axis = 0; axis < 3; ++axis) {
            stream.org[axis] = rays.org[axis].data() + begin;
            stream.dir[axis] = rays.dir[axis].data() + begin;
            stream.normal[axis] = hits.normal[axis].data() + begin;
        }
        stream.t = hits.t.data() + begin;
        stream.slot = hits.slot.data() + begin;
        stream.count = static_cast<std::uint32_t>(piece);
        stream.coherent = path == Path::batch ? 1 : 0;
        stream.units = &units;
        kernels.closest_hit(view(scene), stream);
    }
    return hits;
}

std::vector<std::uint32_t> shuffle(Rays& rays, std::uint64_t seed) {
    Random random(seed);
    std::vector<std::uint32_t> from(rays.size());
    std::iota(from.begin(), from.end(), 0u);
    for (std::size_t i = from.size(); i > 1; --i) std::swap(from[i - 1], from[random.bits() % i]);
    const auto apply = [&](std::vector<float>& values) {
        if (values.empty()) return;
        std::vector<float> moved(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) moved[i] = values[from[i]];
        values = std::move(moved);
    };
    for (int axis = 0; axis < 3; ++axis) apply(rays.org[axis]), apply(rays.dir[axis]);
    apply(rays.tmin), apply(rays.tmax);
    return from;
}

double ulps(float value, double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    return std::fabs(static_cast<double>(value) - exact) / std::ldexp(1.0, exponent - 24);
}

} // namespace lanecast::selftest
