#include "render/whitted_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace lanecast::test {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

dmat4 matrix_of(const Object& object) {
    dmat4 m(1);
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) m = glm::translate(dmat4(1), sphere->position);
    for (const Transformation& t : object.transformations) {
        if (const auto* r = std::get_if<Rotation>(&t))
            m = glm::rotate(dmat4(1), glm::radians(r->degrees), glm::normalize(r->axis)) * m;
        if (const auto* s = std::get_if<Scale>(&t)) m = glm::scale(dmat4(1), s->scale) * m;
        if (const auto* v = std::get_if<Translation>(&t)) m = glm::translate(dmat4(1), v->translate) * m;
    }
    return m;
}

bool is_zero(const dvec3& v) { return v == dvec3(0); }

} // namespace

WhittedOracle::WhittedOracle(const SceneDescription& scene, const RenderSettings& settings)
    : scene_(scene), settings_(settings), epsilon_(1e-9) {
    for (Object& object : scene_.objects) {
        if (!settings.planes && std::holds_alternative<Plane>(object.shape)) continue;
        Material& m = object.material;
        if (!settings.reflections) m.reflective = dvec3(0);
        if (!settings.transmission) m.transmissive = dvec3(0);
        if (!settings.refraction) m.refraction = 0;
        if (!settings.ambient) m.ambient = dvec3(0);
        if (!settings.diffuse) m.diffuse = dvec3(0);
        if (!settings.specular) m.specular = dvec3(0);
        const dmat4 world = matrix_of(object);
        bodies_.push_back({&object, world, glm::inverse(world)});
    }
}

void WhittedOracle::hits_of(const Body& body, std::size_t index, const dvec3& o, const dvec3& d, std::vector<Hit>& hits) const {
    const Object& object = *body.object;
    const dmat3 normal_matrix = glm::transpose(dmat3(body.object_from_world));
    const dvec3 p(body.object_from_world * dvec4(o, 1)), v(body.object_from_world * dvec4(d, 0));
    const auto add = [&](double t, const dvec3& outward) {
        hits.push_back({t, glm::normalize(outward), &object.material, index});
    };
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
        // perpendicular form: stable without tricks in double
        const double tc = -glm::dot(p, v) / glm::dot(v, v);
        const dvec3 nearest = p + v * tc;
        const double h2 = sphere->radius * sphere->radius - glm::dot(nearest, nearest);
        if (h2 < 0) return;
        const double h = std::sqrt(h2 / glm::dot(v, v));
        for (const double t : {tc - h, tc + h}) add(t, normal_matrix * (p + v * t));
    } else if (const auto* cylinder = std::get_if<Cylinder>(&object.shape)) {
        const double r = cylinder->radius, half = cylinder->height / 2;
        const double a = v.x * v.x + v.z * v.z, b = p.x * v.x + p.z * v.z, c = p.x * p.x + p.z * p.z - r * r;
        if (a > 0 && b * b >= a * c)
            for (const double sign : {-1.0, 1.0}) {
                const double t = (-b + sign * std::sqrt(b * b - a * c)) / a;
                const dvec3 q = p + v * t;
                if (std::abs(q.y) <= half) add(t, normal_matrix * dvec3(q.x, 0, q.z));
            }
        for (const double y : {-half, half}) {
            const double t = (y - p.y) / v.y;
            const dvec3 q = p + v * t;
            if (cylinder->capped && std::isfinite(t) && q.x * q.x + q.z * q.z <= r * r) add(t, normal_matrix * dvec3(0, y, 0));
        }
    } else if (const auto* cone = std::get_if<Cone>(&object.shape)) {
        const double half = cone->height / 2, slope = (cone->apex_radius - cone->base_radius) / cone->height;
        const double r = 0.5 * (cone->base_radius + cone->apex_radius) + slope * p.y, dr = slope * v.y;
        const double a = v.x * v.x + v.z * v.z - dr * dr, b = p.x * v.x + p.z * v.z - r * dr, c = p.x * p.x + p.z * p.z - r * r;
        if (a != 0 && b * b >= a * c)
            for (const double sign : {-1.0, 1.0}) {
                const double t = (-b + sign * std::sqrt(b * b - a * c)) / a;
                const dvec3 q = p + v * t;
                if (std::abs(q.y) <= half) add(t, normal_matrix * dvec3(q.x, -slope * (r + dr * t), q.z));
            }
        for (const double y : {-half, half}) {
            const double t = (y - p.y) / v.y, radius = y < 0 ? cone->base_radius : cone->apex_radius;
            const dvec3 q = p + v * t;
            if (cone->capped && std::isfinite(t) && q.x * q.x + q.z * q.z <= radius * radius)
                add(t, normal_matrix * dvec3(0, y, 0));
        }
    } else if (const auto* plane = std::get_if<Plane>(&object.shape)) {
        const double cosine = glm::dot(d, plane->normal);
        if (cosine != 0) add(glm::dot(plane->position - o, plane->normal) / cosine, plane->normal);
    } else {
        const auto& mesh = std::get<Mesh>(object.shape);
        const bool mirrored = glm::determinant(dmat3(body.world_from_object)) < 0;
        for (const auto& triangle : mesh.triangles) {
            dvec3 corner[3];
            for (std::size_t i = 0; i < 3; ++i) corner[i] = dvec3(body.world_from_object * dvec4(mesh.positions[triangle[i]], 1));
            // Moeller and Trumbore 1997
            const dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], s = o - corner[0];
            const dvec3 q = glm::cross(d, e2);
            const double det = glm::dot(e1, q);
            if (det == 0) continue;
            const dvec3 r = glm::cross(s, e1);
            const double b1 = glm::dot(s, q) / det, b2 = glm::dot(d, r) / det;
            if (b1 < 0 || b2 < 0 || b1 + b2 > 1) continue;
            add(glm::dot(e2, r) / det, glm::cross(e1, e2) * (mirrored ? -1.0 : 1.0));
        }
    }
}

std::vector<WhittedOracle::Hit> WhittedOracle::all_hits(const dvec3& o, const dvec3& d, double tmin, double tmax) const {
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < bodies_.size(); ++i) hits_of(bodies_[i], i, o, d, hits);
    std::erase_if(hits, [&](const Hit& hit) { return !(hit.t > tmin && hit.t <= tmax); });
    std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    return hits;
}

dvec3 WhittedOracle::visibility(const dvec3& p, const dvec3& n, const dvec3& to, double tmax) const {
    if (!settings_.shadows) return dvec3(1);
    dvec3 through(1);
    for (const Hit& hit : all_hits(p + n * epsilon_, to, 0, tmax)) {
        if (!settings_.transmissive_shadows) return dvec3(0);
        through *= hit.material->transmissive;
    }
    return through;
}

dvec3 WhittedOracle::direct(const dvec3& p, const dvec3& n, const dvec3& view, const Material& m) const {
    dvec3 sum(0);
    for (const Light& any : scene_.lights) {
        if (const auto* ambient = std::get_if<AmbientLight>(&any)) {
            if (settings_.ambient) sum += ambient->color * m.ambient;
            continue;
        }
        dvec3 color, to;
        double tmax = 1, falloff = 1;
        bool inside_cone = true;
        const auto place = [&](const dvec3& position, const std::array<double, 3>& k) {
            to = position - p;
            const double distance = glm::length(to);
            falloff = 1 / (k[0] + k[1] * distance + k[2] * distance * distance);
        };
        if (const auto* directional = std::get_if<DirectionalLight>(&any)) {
            color = directional->color;
            to = -glm::normalize(directional->direction);
            tmax = std::numeric_limits<double>::infinity();
        } else if (const auto* point = std::get_if<PointLight>(&any)) {
            color = point->color;
            place(point->position, point->attenuation);
        } else {
            const auto& spot = std::get<SpotLight>(any);
            color = spot.color;
            place(spot.position, spot.attenuation);
            const double angle = std::acos(std::clamp(glm::dot(glm::normalize(-to), glm::normalize(spot.direction)), -1.0, 1.0));
            inside_cone = angle <= glm::radians(spot.cutoff);
        }
        const dvec3 l = glm::normalize(to);
        const double cosine = glm::dot(n, l);
        if (cosine <= 0 || !inside_cone) continue;
        const dvec3 half = glm::normalize(l + view);
        const double highlight = std::pow(std::max(glm::dot(n, half), 0.0), m.shininess);
        sum += visibility(p, n, to, tmax) * falloff * color * (m.diffuse * cosine + m.specular * highlight);
    }
    return sum;
}

dvec3 WhittedOracle::trace(const dvec3& o, const dvec3& d, double tmin, int level) const {
    if (level > settings_.depth) return scene_.camera.background;
    const std::vector<Hit> hits = all_hits(o, d, tmin, std::numeric_limits<double>::infinity());
    if (hits.empty()) return scene_.camera.background;
    const Hit& hit = hits.front();
    const Material& m = *hit.material;
    const dvec3 in = glm::normalize(d), p = o + d * hit.t;
    const bool leaving = glm::dot(in, hit.outward) > 0;
    const dvec3 n = leaving ? -hit.outward : hit.outward;
    dvec3 color = direct(p, n, -in, m);
    const double n1 = m.refraction > 0 && leaving ? m.refraction : 1, n2 = m.refraction > 0 && !leaving ? m.refraction : 1;
    const double sine2 = (n1 / n2) * (n1 / n2) * (1 - glm::dot(in, n) * glm::dot(in, n)); // of the transmitted ray
    const bool total = sine2 > 1;
    if (!is_zero(m.reflective)) {
        double f = 1;
        if (settings_.schlick && m.refraction > 0) {
            const double r0 = std::pow((n1 - n2) / (n1 + n2), 2);
            const double cosine = n1 > n2 ? std::sqrt(std::max(1 - sine2, 0.0)) : -glm::dot(in, n);
            f = total ? 1 : r0 + (1 - r0) * std::pow(1 - cosine, 5);
        }
        color += f * m.reflective * trace(p + n * epsilon_, glm::reflect(in, n), 0, level + 1);
    }
    if (!is_zero(m.transmissive)) {
        const dvec3 way = m.refraction <= 0 ? in : total ? glm::reflect(in, n) : glm::refract(in, n, n1 / n2);
        const dvec3 start = total && m.refraction > 0 ? p + n * epsilon_ : p - n * epsilon_;
        color = color * (1.0 - m.transmissive) + m.transmissive * trace(start, way, 0, level + 1);
    }
    return color;
}

dvec3 WhittedOracle::color_at(double x, double y, int width, int height) const {
    const Camera& camera = scene_.camera;
    const dvec3 forward = glm::normalize(camera.look_at - camera.position);
    const dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
    const double top = std::tan(glm::radians(camera.field) / 2);
    const double u = (2 * x - width) / height * top, v = (height - 2 * y) / height * top;
    return trace(camera.position, forward + u * right + v * up, camera.near, 0);
}

} // namespace lanecast::test
