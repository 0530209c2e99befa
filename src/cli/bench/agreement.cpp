#include "cli/bench/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace lanecast::bench {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Traces `rays`, whose tmax is the set's.
HitList trace(const Scene& scene, const RaySet& rays) {
    const std::size_t n = rays.size();
    HitList list;
    list.t.assign(n, infinity);
    const std::vector<float> tmax(n, rays.tmax);
    RayArrays asked;
    asked.org_x = rays.org[0].data();
    asked.org_y = rays.org[1].data();
    asked.org_z = rays.org[2].data();
    asked.dir_x = rays.dir[0].data();
    asked.dir_y = rays.dir[1].data();
    asked.dir_z = rays.dir[2].data();
    asked.tmax = tmax.data();
    asked.count = n;
    if (rays.query == Query::any) {
        std::vector<std::uint8_t> occluded(n);
        scene.any_hit(asked, occluded.data());
        for (std::size_t i = 0; i < n; ++i)
            if (occluded[i] != 0) list.t[i] = 0;
    } else {
        list.primitive.assign(n, no_hit);
        HitArrays hits;
        hits.t = list.t.data();
        hits.primitive = list.primitive.data();
        scene.closest_hit(asked, hits);
    }
    return list;
}

bool same(float a, float b) {
    if (std::isinf(a) || std::isinf(b)) return a == b;
    return std::abs(a - b) <= 1e-3f * std::max(std::abs(a), std::abs(b));
}

glm::dvec3 at(const std::vector<float> (&v)[3], std::size_t i) { return {v[0][i], v[1][i], v[2][i]}; }

/// The truths of rays beside one, by the rounding of its origin and direction.
struct Beside {
    std::vector<float> t;
    float near = infinity, far = -infinity;
};

Beside truths_beside(const Truth& truth, std::size_t i) {
    RaySet beside;
    beside.query = truth.set->query;
    beside.tmax = truth.set->tmax;
    const glm::dvec3 o = at(truth.set->org, i), d = at(truth.set->dir, i);
    const double length = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    for (const double size : {1.0, 4.0})
        for (int k = 0; k < 27; ++k) {
            const glm::dvec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            beside.add(o + step * (size * truth.rounding), d);
            beside.add(o, d + step * (size * 2.4e-7 * length));
        }
    Beside truths;
    truths.t = trace(*truth.reference, beside).t;
    for (const float t : truths.t) {
        truths.near = std::min(truths.near, t);
        truths.far = std::max(truths.far, t);
    }
    return truths;
}

/// One of them; or between them where they are close, as for a ray that starts a few roundings above a surface.
bool is_among(float t, const Beside& truths) {
    if (t >= truths.near && t <= truths.far && truths.far <= 4 * truths.near) return true;
    return std::any_of(truths.t.begin(), truths.t.end(), [&](float other) { return same(t, other); });
}

void compare_ray(float a, float b, float true_t, const Truth& truth, std::size_t i, Disagreements& found) {
    if (same(a, b)) return;
    ++(std::isinf(a) ? found.missed : std::isinf(b) ? found.extra : found.other_t);
    const Beside truths = truths_beside(truth, i);
    if (is_among(a, truths) && is_among(b, truths))
        ++found.edges;
    else if (same(a, true_t))
        ++found.upheld;
}

} // namespace

Truth find_truth(const RaySet& set, const Scene& reference, const BenchMesh& mesh, std::size_t count) {
    Truth truth{.set = &set, .reference = &reference, .rounding = 0, .rays = {}, .hits = {}};
    for (int axis = 0; axis < 3; ++axis)
        truth.rounding = std::max({truth.rounding, 6e-8 * std::abs(mesh.lo[axis]), 6e-8 * std::abs(mesh.hi[axis])});
    RaySet checked;
    checked.query = set.query;
    checked.tmax = set.tmax;
    count = std::min(count, set.size());
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = k * set.size() / count;
        truth.rays.push_back(i);
        checked.add(at(set.org, i), at(set.dir, i));
    }
    truth.hits = trace(reference, checked);
    return truth;
}

Disagreements compare_to_truth(const HitList& hits, const Truth& truth) {
    Disagreements found;
    for (std::size_t k = 0; k < truth.rays.size(); ++k) {
        const std::size_t i = truth.rays[k];
        const float a = hits.t[i], b = truth.hits.t[k];
        ++found.checked;
        compare_ray(a, b, b, truth, i, found);
        if (!hits.primitive.empty() && same(a, b) && hits.primitive[i] != truth.hits.primitive[k]) ++found.ties;
    }
    return found;
}

Disagreements compare_to_peer(const HitList& hits, const HitList& peer, const Truth& truth) {
    Disagreements found;
    for (std::size_t k = 0; k < truth.rays.size(); ++k) {
        const std::size_t i = truth.rays[k];
        ++found.checked;
        compare_ray(hits.t[i], peer.t[i], truth.hits.t[k], truth, i, found);
        if (!hits.primitive.empty() && same(hits.t[i], peer.t[i]) && hits.primitive[i] != peer.primitive[i]) ++found.ties;
    }
    return found;
}

} // namespace lanecast::bench
