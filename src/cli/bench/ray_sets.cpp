#include "cli/bench/ray_sets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace lanecast::bench {
namespace {

constexpr int image_width = 1920, image_height = 1080;
constexpr int block = 32;
constexpr int blocks_across = image_width / block, blocks_down = image_height / block; // the last 24 rows are left out
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Pixel {
    int x, y;
};

/// Pixels of every k-th block, so that `count` rays, `per_pixel` each, are spread over the image.
std::vector<Pixel> pick_pixels(std::size_t count, std::size_t per_pixel) {
    const std::size_t all = std::size_t{blocks_across} * blocks_down;
    const std::size_t wanted = std::clamp<std::size_t>(count / (per_pixel * block * block), 1, all);
    std::vector<Pixel> pixels;
    for (std::size_t k = 0; k < wanted; ++k) {
        const int b = static_cast<int>(k * all / wanted);
        const int x0 = b % blocks_across * block, y0 = b / blocks_across * block;
        for (std::uint32_t i = 0; i < block * block; ++i) {
            int x = 0, y = 0;
            for (std::uint32_t bit = 0; bit < 5; ++bit) {
                x |= static_cast<int>(i >> (2 * bit) & 1u) << bit;
                y |= static_cast<int>(i >> (2 * bit + 1) & 1u) << bit;
            }
            pixels.push_back({x0 + x, y0 + y});
        }
    }
    return pixels;
}

class PixelRays {
public:
    explicit PixelRays(const View& view) {
        forward_ = glm::normalize(view.look_at - view.position);
        right_ = glm::normalize(glm::cross(forward_, view.up));
        up_ = glm::cross(right_, forward_);
        pixel_ = 2 * std::tan(view.field * std::numbers::pi / 360) / image_height;
    }
    [[nodiscard]] glm::dvec3 through(double x, double y) const {
        return glm::normalize(forward_ + right_ * ((x - 0.5 * image_width) * pixel_) + up_ * ((0.5 * image_height - y) * pixel_));
    }

private:
    glm::dvec3 forward_, right_, up_;
    double pixel_ = 0;
};

RaySet camera_rays(const View& view, std::size_t count, const std::string& name) {
    RaySet set;
    set.name = name;
    set.common_origin = true;
    set.coherence = Coherence::coherent;
    set.tmax = infinity;
    const PixelRays camera(view);
    const bool offsets = name == "aa";
    for (const Pixel& p : pick_pixels(count, offsets ? 4 : 1)) {
        const double x = p.x + 0.5, y = p.y + 0.5;
        if (!offsets) {
            set.add(view.position, camera.through(x, y));
            continue;
        }
        for (const auto& [dx, dy] :
             {std::array{.25, 1.25}, std::array{1.25, -.25}, std::array{-.25, -1.25}, std::array{-1.25, .25}})
            set.add(view.position, camera.through(x + dx, y + dy));
    }
    return set;
}

/// A hit of a primary ray, moved off the surface to the ray's side.
struct Start {
    glm::dvec3 point, normal, dir;
};

RayArrays arrays_of(const RaySet& set) {
    RayArrays rays;
    rays.org_x = set.org[0].data();
    rays.org_y = set.org[1].data();
    rays.org_z = set.org[2].data();
    rays.dir_x = set.dir[0].data();
    rays.dir_y = set.dir[1].data();
    rays.dir_z = set.dir[2].data();
    rays.count = set.size();
    return rays;
}

std::vector<Start> find_starts(const BenchMesh& mesh, const Scene& scene, const RaySet& primary) {
    std::vector<float> t(primary.size()), n[3];
    for (std::vector<float>& axis : n) axis.resize(primary.size());
    HitArrays hits;
    hits.t = t.data();
    hits.normal_x = n[0].data();
    hits.normal_y = n[1].data();
    hits.normal_z = n[2].data();
    scene.closest_hit(arrays_of(primary), hits);
    const double extent = glm::length(mesh.hi - mesh.lo);
    std::vector<Start> starts;
    for (std::size_t i = 0; i < primary.size(); ++i) {
        if (!std::isfinite(t[i])) continue;
        const glm::dvec3 dir(primary.dir[0][i], primary.dir[1][i], primary.dir[2][i]);
        const glm::dvec3 org(primary.org[0][i], primary.org[1][i], primary.org[2][i]);
        glm::dvec3 normal(n[0][i], n[1][i], n[2][i]);
        if (glm::dot(normal, dir) > 0) normal = -normal;
        starts.push_back({org + dir * static_cast<double>(t[i]) + normal * (extent * 2e-6), normal, dir});
    }
    return starts;
}

std::uint32_t hash(std::uint32_t h) {
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return h ^ h >> 16;
}

glm::dvec3 cosine_direction(const glm::dvec3& normal, std::uint32_t i) {
    const double r2 = hash(2 * i + 1) / 4294967296.0, angle = 2 * std::numbers::pi * hash(2 * i + 2) / 4294967296.0;
    const glm::dvec3 side =
        glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const double r = std::sqrt(r2);
    return glm::normalize(side * (r * std::cos(angle)) + glm::cross(normal, side) * (r * std::sin(angle)) +
                          normal * std::sqrt(1 - r2));
}

RaySet spawned_rays(const View& view, const std::vector<Start>& starts, const std::string& name) {
    RaySet set;
    set.name = name;
    set.tmax = infinity;
    const glm::dvec3 sun = glm::normalize(view.sun);
    if (name == "shadow" || name == "light" || name == "sun") set.query = Query::any;
    if (name == "shadow" || name == "light") set.tmax = 1;
    set.common_origin = name == "light";
    if (name == "light") set.coherence = Coherence::coherent;
    if (name == "diffuse") set.coherence = Coherence::incoherent;
    for (std::uint32_t i = 0; i < starts.size(); ++i) {
        const Start& s = starts[i];
        if (name == "mirror") set.add(s.point, s.dir - s.normal * (2 * glm::dot(s.dir, s.normal)));
        if (name == "diffuse") set.add(s.point, cosine_direction(s.normal, i));
        if (name == "sun" && glm::dot(s.normal, sun) > 0) set.add(s.point, sun);
        const glm::dvec3 to_light = view.light - s.point;
        if (glm::dot(s.normal, to_light) <= 0) continue;
        if (name == "shadow") set.add(s.point, to_light);
        if (name == "light") set.add(view.light, -to_light);
    }
    return set;
}

} // namespace

const std::vector<std::string>& ray_kinds() {
    static const std::vector<std::string> kinds{"primary", "aa", "shadow", "light", "sun", "mirror", "diffuse"};
    return kinds;
}

std::vector<RaySet> make_ray_sets(const BenchMesh& mesh, const Scene& scene, const std::vector<std::string>& kinds,
                                  std::size_t count) {
    std::vector<RaySet> sets;
    const RaySet primary = camera_rays(mesh.view, count, "primary");
    const std::vector<Start> starts = find_starts(mesh, scene, primary);
    for (const std::string& kind : kinds) {
        RaySet set =
            kind == "primary" || kind == "aa" ? camera_rays(mesh.view, count, kind) : spawned_rays(mesh.view, starts, kind);
        if (set.size() > 0) sets.push_back(std::move(set));
    }
    return sets;
}

} // namespace lanecast::bench
