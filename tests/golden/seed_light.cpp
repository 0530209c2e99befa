#include "golden/seed_light.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace lanecast::test {
namespace {

/// One light as a surface sees it.
template <class Real>
struct Incoming {
    Vec<Real> wi;     ///< unit, to the light
    Vec<Real> shadow; ///< direction of the shadow ray; t = 1 is the light unless it is directional
    Vec<Real> color;  ///< attenuated
    bool directional = false;
    bool spot = false;
    Vec<Real> against_axis{0}; ///< of a spot's cone, unit
    bool in_cone = true;
};

template <class Real>
Real attenuation(const SeedFaults& faults, const std::array<double, 3>& terms, Real d) {
    if (faults.light_grows) return Real(1) + Real(0.001) * d + Real(0.00001) * d * d;
    return Real(1) / (static_cast<Real>(terms[0]) + static_cast<Real>(terms[1]) * d + static_cast<Real>(terms[2]) * d * d);
}

template <class Real>
Incoming<Real> incoming(const SeedFaults& faults, const Light& light, const Vec<Real>& point) {
    if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
        const Vec<Real> against(-directional->direction);
        return {.wi = glm::normalize(against), .shadow = against, .color = Vec<Real>(directional->color), .directional = true};
    }
    const auto from = [&](const auto& source) {
        const Vec<Real> to_light = Vec<Real>(source.position) - point;
        return Incoming<Real>{.wi = glm::normalize(to_light),
                              .shadow = to_light,
                              .color = Vec<Real>(source.color) * attenuation(faults, source.attenuation, glm::length(to_light))};
    };
    if (const auto* at = std::get_if<PointLight>(&light)) return from(*at);
    const auto& spot = std::get<SpotLight>(light);
    Incoming<Real> in = from(spot);
    in.spot = true;
    in.against_axis = -glm::normalize(Vec<Real>(spot.direction));
    in.in_cone = glm::dot(in.wi, in.against_axis) >= std::cos(glm::radians(static_cast<Real>(spot.cutoff)));
    return in;
}

template <class Real>
bool is_blocked(const SeedScene<Real>& scene, const SeedFaults& faults, const SeedSurface<Real>& surface,
                const Incoming<Real>& in) {
    const SeedHit<Real> hit = closest_hit(scene, faults, spawn(faults, surface, in.shadow));
    if (hit.body < 0) return false;
    if (!in.directional) return hit.t <= 1;
    return !(faults.planes_never_shadow && scene.bodies[static_cast<std::size_t>(hit.body)].kind == BodyKind::plane);
}

template <class Real>
Vec<Real> reflected(const SeedFaults& faults, const Material& material, const Incoming<Real>& in, const Vec<Real>& n,
                    const Vec<Real>& view) {
    const Vec<Real> kd(material.diffuse), ks(material.specular);
    const auto unit_range = [](const auto& x) { return glm::clamp(x, Real(0), Real(1)); }; // only long plane normals exceed it
    Vec<Real> diffuse = kd * unit_range(glm::dot(n, in.wi));
    if (in.spot && faults.spot_axis) diffuse = kd * unit_range(kd * glm::dot(n, in.against_axis));
    Real cos_half = glm::dot(n, glm::normalize(in.wi + view));
    if (!(in.directional && faults.directional_power)) cos_half = std::max(cos_half, Real(0));
    const Real power = std::pow(cos_half, static_cast<Real>(material.shininess));
    const Vec<Real> sum = diffuse + ks * (power > 0 ? std::min(power, Real(1)) : Real(0)); // a NaN counts as 0
    return faults.clamped_light ? Vec<Real>(unit_range(sum)) : sum;
}

} // namespace

template <class Real>
SeedRay<Real> spawn(const SeedFaults& faults, const SeedSurface<Real>& surface, const Vec<Real>& dir) {
    if (faults.absolute_tmin) return {.org = surface.point, .dir = dir, .tmin = Real(0.001)};
    const Vec<Real> size = glm::abs(surface.point);
    const Real slack = Real(16) * std::numeric_limits<Real>::epsilon() * (Real(1) + std::max({size.x, size.y, size.z}));
    return {.org = surface.point,
            .dir = dir,
            .tmin = slack / glm::length(dir),
            .source = surface.body,
            .inward = glm::dot(dir, surface.normal) < 0};
}

template <class Real>
Vec<Real> local_light(const SceneDescription& description, const SeedScene<Real>& scene, const SeedFaults& faults,
                      const SeedSurface<Real>& surface) {
    const Material& material = *scene.bodies[static_cast<std::size_t>(surface.body)].material;
    const Vec<Real> n = surface.inside && !faults.unflipped_normal ? -surface.normal : surface.normal;
    Vec<Real> color(0);
    for (const Light& light : description.lights) {
        if (const auto* ambient = std::get_if<AmbientLight>(&light)) {
            color += Vec<Real>(ambient->color) * Vec<Real>(material.ambient);
            continue;
        }
        const Incoming<Real> in = incoming(faults, light, surface.point);
        if (!in.in_cone) continue;
        if (!faults.unmasked_specular && !(glm::dot(n, in.wi) > 0)) continue;
        const Vec<Real> share = in.color * reflected(faults, material, in, n, surface.view);
        if (share == Vec<Real>(0) || is_blocked(scene, faults, surface, in)) continue;
        color += share;
    }
    return color;
}

template SeedRay<float> spawn<float>(const SeedFaults&, const SeedSurface<float>&, const Vec<float>&);
template SeedRay<double> spawn<double>(const SeedFaults&, const SeedSurface<double>&, const Vec<double>&);
template Vec<float> local_light<float>(const SceneDescription&, const SeedScene<float>&, const SeedFaults&,
                                       const SeedSurface<float>&);
template Vec<double> local_light<double>(const SceneDescription&, const SeedScene<double>&, const SeedFaults&,
                                         const SeedSurface<double>&);

} // namespace lanecast::test
