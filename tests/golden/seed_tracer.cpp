#include "golden/seed_tracer.hpp"

#include "golden/seed_light.hpp"

#include <cmath>
#include <thread>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace lanecast::test {
namespace {

template <class Real>
class Tracer {
public:
    Tracer(const SceneDescription& description, const RenderSettings& settings, const SeedFaults& faults, int width, int height)
        : description_(description), settings_(settings), faults_(faults), scene_(make_seed_scene<Real>(description, faults)),
          background_(description.camera.background), width_(static_cast<Real>(width)), height_(static_cast<Real>(height)),
          half_height_(std::tan(glm::radians(static_cast<Real>(description.camera.field)) / 2)) {}

    [[nodiscard]] Vec<Real> pixel(int x, int y) const {
        const Real cx = static_cast<Real>(x) + Real(0.5), cy = static_cast<Real>(y) + Real(0.5);
        int body = -1;
        const Vec<Real> centre = through(cx, cy, body);
        const AntiAliasing& anti_aliasing = settings_.anti_aliasing;
        if (anti_aliasing.mode != AntiAliasMode::cross || body < 0) return centre;
        const auto offset = static_cast<Real>(anti_aliasing.offset);
        return (centre + through(cx + offset, cy, body) + through(cx - offset, cy, body) + through(cx, cy + offset, body) +
                through(cx, cy - offset, body)) /
               Real(5);
    }

private:
    /// `body`: that of the hit, -1 for none.
    [[nodiscard]] Vec<Real> through(Real x, Real y, int& body) const {
        const Real half_width = half_height_ * width_ / height_;
        const Vec<Real> dir(half_width * (2 * x / width_ - 1), half_height_ * (1 - 2 * y / height_), -1);
        const SeedRay<Real> ray{.org = Vec<Real>(0), .dir = dir, .tmin = static_cast<Real>(description_.camera.near)};
        return trace(ray, 0, body);
    }

    [[nodiscard]] Vec<Real> child(const SeedSurface<Real>& surface, const Vec<Real>& dir, int level) const {
        int body = -1;
        return trace(spawn(faults_, surface, dir), level, body);
    }

    [[nodiscard]] Vec<Real> trace(const SeedRay<Real>& ray, int level, int& body) const {
        if (level > settings_.depth) return background_;
        const SeedHit<Real> hit = closest_hit(scene_, faults_, ray);
        body = hit.body;
        if (body < 0) return background_;
        SeedSurface<Real> surface{.point = hit.point, .view = -glm::normalize(ray.dir), .normal = hit.normal, .body = body};
        surface.inside = glm::dot(ray.dir, hit.normal) > 0;
        const Material& material = *scene_.bodies[static_cast<std::size_t>(body)].material;
        Vec<Real> color = local_light(description_, scene_, faults_, surface);
        if (material.reflective != glm::dvec3(0)) {
            const Vec<Real> mirrored = 2 * glm::dot(surface.normal, surface.view) * surface.normal - surface.view;
            const Real fresnel = settings_.schlick ? schlick(surface, ray.dir, material) : Real(1);
            color += fresnel * Vec<Real>(material.reflective) * child(surface, mirrored, level + 1);
        }
        if (material.transmissive != glm::dvec3(0)) {
            const Vec<Real> share(material.transmissive);
            const Vec<Real> onward = material.refraction > 0 ? bent(surface, ray.dir, material) : ray.dir;
            color = (Real(1) - share) * color + share * child(surface, onward, level + 1);
        }
        return faults_.clamped_bounce ? Vec<Real>(glm::clamp(color, Real(0), Real(1))) : color;
    }

    /// How the ray's direction enters the laws of refraction.
    struct Interface {
        Vec<Real> d, n; ///< n faces d
        Real n1, n2;
        Real cos_in;
        Real k; ///< squared cosine of the transmitted ray; negative under total internal reflection
    };

    [[nodiscard]] Interface interface(const SeedSurface<Real>& surface, const Vec<Real>& dir, const Material& material) const {
        const auto index = static_cast<Real>(material.refraction);
        Interface at{.d = faults_.unnormalised_snell ? dir : glm::normalize(dir),
                     .n = surface.inside ? -surface.normal : surface.normal,
                     .n1 = surface.inside ? index : Real(1),
                     .n2 = surface.inside ? Real(1) : index,
                     .cos_in = 0,
                     .k = 0};
        at.cos_in = -glm::dot(at.d, at.n);
        const Real eta = at.n1 / at.n2;
        at.k = 1 - eta * eta * (1 - at.cos_in * at.cos_in);
        return at;
    }

    [[nodiscard]] Vec<Real> bent(const SeedSurface<Real>& surface, const Vec<Real>& dir, const Material& material) const {
        const Interface at = interface(surface, dir, material);
        if (at.k < 0) return at.d + 2 * at.cos_in * at.n;
        return (at.d + at.cos_in * at.n) * (at.n1 / at.n2) - std::sqrt(at.k) * at.n;
    }

    [[nodiscard]] Real schlick(const SeedSurface<Real>& surface, const Vec<Real>& dir, const Material& material) const {
        if (!(material.refraction > 0)) return 1;
        const Interface at = interface(surface, dir, material);
        const Real ratio = (at.n1 - at.n2) / (at.n1 + at.n2);
        const Real r0 = ratio * ratio;
        if (at.k < 0 && !faults_.incident_schlick) return 1;
        const Real cosine = at.n1 > at.n2 && !faults_.incident_schlick ? std::sqrt(at.k) : at.cos_in;
        return r0 + (1 - r0) * std::pow(1 - cosine, Real(5));
    }

    const SceneDescription& description_;
    const RenderSettings& settings_;
    const SeedFaults& faults_;
    SeedScene<Real> scene_;
    Vec<Real> background_;
    Real width_, height_, half_height_;
};

template <class Real>
void render(const Tracer<Real>& tracer, Film& film, int threads, std::span<const std::uint8_t> wanted) {
    const auto rows = [&](int first) {
        for (int y = first; y < film.height; y += threads)
            for (int x = 0; x < film.width; ++x) {
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(x);
                if (!wanted.empty() && wanted[at] == 0) continue;
                const Vec<Real> color = tracer.pixel(x, y);
                for (int c = 0; c < 3; ++c) film.rgb[static_cast<std::size_t>(c)][at] = static_cast<float>(color[c]);
            }
    };
    std::vector<std::jthread> workers;
    for (int i = 1; i < threads; ++i) workers.emplace_back(rows, i);
    rows(0);
}

} // namespace

Film render_seed(const SceneDescription& description, const RenderSettings& settings, const SeedFaults& faults, int width,
                 int height, int threads, std::span<const std::uint8_t> wanted) {
    Film film = make_film(width, height, {0, 0, width, height});
    if (faults.single_precision)
        render(Tracer<float>(description, settings, faults, width, height), film, threads, wanted);
    else
        render(Tracer<double>(description, settings, faults, width, height), film, threads, wanted);
    return film;
}

} // namespace lanecast::test
