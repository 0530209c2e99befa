#include "golden/spd_rays.hpp"

#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace lanecast::test {
namespace {

using glm::dvec3;

struct Ray {
    dvec3 org, dir;
    double tmax = 3e38;
};
struct Hit {
    float t = 0;
    std::int32_t slot = -1;
};

dvec3 vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// The nearest hits, polygons seen from behind left out where they are one-sided.
class Tracer {
public:
    Tracer(const SceneView& scene, const KernelTable& kernels, bool one_sided)
        : scene_(scene), kernels_(kernels), one_sided_(one_sided) {}

    [[nodiscard]] std::vector<Hit> operator()(const std::vector<Ray>& rays) const {
        std::vector<Hit> hits(rays.size());
        std::vector<float> tmin(rays.size(), 0.0f);
        std::vector<std::size_t> asked(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) asked[i] = i;
        while (!asked.empty()) {
            ask(rays, asked, tmin, hits);
            std::erase_if(asked, [&](std::size_t i) {
                if (!is_behind(rays[i], hits[i])) return true;
                tmin[i] = std::nextafter(hits[i].t, 3e38f);
                return false;
            });
        }
        return hits;
    }

private:
    [[nodiscard]] bool is_behind(const Ray& ray, const Hit& hit) const {
        if (!one_sided_ || hit.slot < 0 || static_cast<std::uint32_t>(hit.slot) >= scene_.first_slot[1]) return false;
        const MaterialRecord& material = scene_.materials[scene_.material[hit.slot]];
        return material.transmissive[0] == 0.0f && glm::dot(vec(scene_.triangles[hit.slot].normal), ray.dir) > 0;
    }

    void ask(const std::vector<Ray>& rays, const std::vector<std::size_t>& asked, const std::vector<float>& tmins,
             std::vector<Hit>& hits) const {
        const std::size_t n = asked.size();
        std::vector<float> numbers[9];
        for (auto& row : numbers) row.resize(n);
        std::vector<std::int32_t> slot(n);
        for (std::size_t i = 0; i < n; ++i) {
            const Ray& ray = rays[asked[i]];
            for (int axis = 0; axis < 3; ++axis) {
                numbers[axis][i] = static_cast<float>(ray.org[axis]);
                numbers[3 + axis][i] = static_cast<float>(ray.dir[axis]);
            }
            numbers[6][i] = tmins[asked[i]];
            numbers[7][i] = static_cast<float>(ray.tmax);
        }
        RayStream stream{};
        for (int axis = 0; axis < 3; ++axis) stream.org[axis] = numbers[axis].data(), stream.dir[axis] = numbers[3 + axis].data();
        stream.tmin = numbers[6].data();
        stream.tmax = numbers[7].data();
        stream.t = numbers[8].data();
        stream.slot = slot.data();
        stream.count = static_cast<std::uint32_t>(n);
        kernels_.closest_hit(scene_, stream);
        for (std::size_t i = 0; i < n; ++i) hits[asked[i]] = {numbers[8][i], slot[i]};
    }

    const SceneView& scene_;
    const KernelTable& kernels_;
    bool one_sided_;
};

struct Surface {
    dvec3 point, normal; ///< unit, faces the ray
    double step;         ///< beyond the error of `point`
    bool inside;
    bool curved;
};

dvec3 outward_normal(const SceneView& scene, std::uint32_t slot, const dvec3& p) {
    if (slot < scene.first_slot[1]) return vec(scene.triangles[slot].normal);
    if (slot < scene.first_slot[2]) return glm::normalize(p - vec(scene.spheres[slot - scene.first_slot[1]].centre));
    const AffineRecord& r = scene.affines[slot - scene.first_slot[2]];
    const auto row = [&](int i) { return dvec3(r.object_from_world[i], r.object_from_world[i + 1], r.object_from_world[i + 2]); };
    const dvec3 q = p - vec(r.translation);
    const double x = glm::dot(row(0), q), z = glm::dot(row(6), q), distance = std::hypot(x, z);
    return glm::normalize(row(0) * (x / distance) - row(3) * double{r.taper} + row(6) * (z / distance));
}

Surface surface_at(const SceneView& scene, const Ray& ray, const Hit& hit) {
    const dvec3 p = ray.org + ray.dir * double{hit.t}, n = outward_normal(scene, static_cast<std::uint32_t>(hit.slot), p);
    const bool inside = glm::dot(n, ray.dir) > 0;
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), glm::length(ray.dir) * double{hit.t}});
    return {p, inside ? -n : n, 4e-6 * size, inside, static_cast<std::uint32_t>(hit.slot) >= scene.first_slot[1]};
}

/// From the side the ray came from; but a curved surface does not hide the light that its own front faces.
void add_shadow_rays(const SceneView& scene, const Surface& s, Facing facing, std::vector<Ray>& rays) {
    const dvec3 facing_normal = facing == Facing::front && s.inside ? -s.normal : s.normal;
    const dvec3 start = s.point + (s.curved ? facing_normal : s.normal) * s.step;
    for (std::uint32_t k = 0; k < scene.light_count; ++k) {
        const dvec3 to_light = vec(scene.lights[k].position) - start;
        if (glm::dot(to_light, facing_normal) > 0) rays.push_back({start, to_light, 1});
    }
}

/// Snell's law; nothing under total reflection.
std::optional<dvec3> refracted(const dvec3& d, const Surface& s, double index) {
    const double eta = s.inside ? index : 1 / index, cosine = -glm::dot(d, s.normal);
    const double k = 1 - eta * eta * (1 - cosine * cosine);
    if (k < 0) return std::nullopt;
    return d * eta + s.normal * (eta * cosine - std::sqrt(k));
}

std::vector<Ray> eye_rays(const Camera& camera, const Normalisation& to, int corners) {
    const dvec3 forward = glm::normalize(camera.look_at - camera.position);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const double half = std::tan(glm::radians(camera.field) / 2);
    const dvec3 eye = (camera.position - to.centre) * to.scale;
    std::vector<Ray> rays;
    for (int y = 0; y < corners; ++y)
        for (int x = 0; x < corners; ++x) {
            const double sx = 2.0 * x / (corners - 1) - 1, sy = 1 - 2.0 * y / (corners - 1);
            rays.push_back({eye, glm::normalize(forward + right * (sx * half) + up * (sy * half))});
        }
    return rays;
}

} // namespace

SpdCounts count_spd_rays(const SceneDescription& description, const SpdRules& rules, const KernelTable& kernels) {
    const SceneArrays arrays = flatten(description, RenderSettings{}, 1);
    const SceneView scene = view(arrays);
    const Tracer trace(scene, kernels, rules.one_sided);
    SpdCounts counts;
    std::vector<Ray> rays = eye_rays(description.camera, arrays.normalisation, rules.corners);
    counts.eye = rays.size();
    for (int level = 1; level <= rules.levels && !rays.empty(); ++level) {
        const std::vector<Hit> hits = trace(rays);
        std::vector<Ray> shadow, next;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].slot < 0) continue;
            ++(level == 1 ? counts.eye_hits : counts.secondary_hits);
            const dvec3& d = rays[i].dir;
            const Surface s = surface_at(scene, rays[i], hits[i]);
            add_shadow_rays(scene, s, rules.facing, shadow);
            const MaterialRecord& material = scene.materials[scene.material[hits[i].slot]];
            const bool clear = material.transmissive[0] > 0.0f;
            if (level == rules.levels || (!clear && material.reflective[0] == 0.0f)) continue;
            next.push_back({s.point + s.normal * s.step, d - s.normal * (2 * glm::dot(d, s.normal))});
            ++counts.reflected;
            if (!clear) continue;
            if (const auto through = refracted(d, s, double{material.refraction})) {
                next.push_back({s.point - s.normal * s.step, *through});
                ++counts.refracted;
            }
        }
        counts.shadow += shadow.size();
        for (const Hit& hit : trace(shadow)) counts.blocked += hit.slot >= 0;
        rays = std::move(next);
    }
    return counts;
}

} // namespace lanecast::test
