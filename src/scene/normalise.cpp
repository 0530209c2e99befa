#include "scene/normalise.hpp"

#include "scene/error.hpp"
#include "scene/transform.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include <glm/geometric.hpp>

namespace lanecast {
namespace {

constexpr int comfortable_exponent = 40; ///< |x| <= 2^40 squares to 2^80, far from float's 2^128
constexpr int largest_exponent = 60;     ///< beyond it the geometry would shrink under 2^-20
constexpr int exponent_limit = 900;      ///< of the extent in world units, so that its square root, inverse and square are normal
constexpr int finest_centre_bits = 20;   ///< the centre is a multiple of extent / 2^20 or of something coarser

/// Smallest e with 2^e >= x, x > 0.
int ceil_log2(double x) {
    int e = 0;
    const double fraction = std::frexp(x, &e); // x = fraction * 2^e, fraction in [1/2, 1)
    return fraction == 0.5 ? e - 1 : e;
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The roundest centre for which the box stays within 2^e of it on this axis, or NaN.
double round_centre(double lo, double hi, int e) {
    const double middle = 0.5 * lo + 0.5 * hi, size = std::ldexp(1.0, e);
    for (int bits = -1; bits <= finest_centre_bits; ++bits) {
        const double grid = std::ldexp(1.0, e - bits);
        const double centre = std::nearbyint(middle / grid) * grid;
        if (hi - centre <= size && centre - lo <= size) return centre;
    }
    return std::nan("");
}

std::string label(const char* list, std::size_t index) { return std::string("/") + list + "/" + std::to_string(index); }

/// What is not bounded geometry but has a place, with its distance from `centre`.
template <class Visit>
void for_each_outlier(const SceneDescription& scene, bool with_planes, const glm::dvec3& centre, Visit&& visit) {
    visit("/camera", largest(scene.camera.position - centre));
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        std::visit(
            [&](const auto& light) {
                if constexpr (requires { light.position; }) visit(label("lights", i), largest(light.position - centre));
            },
            scene.lights[i]);
    if (!with_planes) return;
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        if (const auto* plane = std::get_if<Plane>(&scene.objects[i].shape))
            visit(label("objects", i), std::abs(glm::dot(unit(plane->normal), plane->position - centre)));
}

/// Stands in where nothing is bounded.
DoubleBox bounds_of_places(const SceneDescription& scene, bool with_planes) {
    DoubleBox box;
    include(box, scene.camera.position);
    for (const Light& any : scene.lights)
        std::visit(
            [&](const auto& light) {
                if constexpr (requires { light.position; }) include(box, light.position);
            },
            any);
    if (with_planes)
        for (const Object& object : scene.objects)
            if (const auto* plane = std::get_if<Plane>(&object.shape)) include(box, plane->position);
    return box;
}

} // namespace

Normalisation find_normalisation(const DoubleBox& bounds, const SceneDescription& scene, bool with_planes) {
    DoubleBox box = bounds;
    if (is_empty(box) || !(largest(box.hi - box.lo) > 0)) include(box, bounds_of_places(scene, with_planes));
    double half = 0;
    for (int axis = 0; axis < 3; ++axis) half = std::max(half, 0.5 * box.hi[axis] - 0.5 * box.lo[axis]);
    if (!(half > 0)) half = largest(scene.camera.look_at - scene.camera.position); // one point: any length of the file will do
    if (!(half > 0)) half = 1;
    if (!std::isfinite(half) || std::abs(std::ilogb(half)) > exponent_limit)
        throw Error(ExitCode::scene, "the extent of the scene's geometry is outside 2^-900 to 2^900: use other units");

    Normalisation result;
    int e = ceil_log2(half);
    for (bool fits = false; !fits; e += fits ? 0 : 1) {
        fits = true;
        for (int axis = 0; axis < 3; ++axis) {
            result.centre[axis] = round_centre(box.lo[axis], box.hi[axis], e);
            if (std::isnan(result.centre[axis])) fits = false;
        }
    }

    int needed = e;
    for_each_outlier(scene, with_planes, result.centre, [&](const std::string& name, double distance) {
        if (distance == 0) return;
        const int far = std::isfinite(distance) ? ceil_log2(distance) : 1100;
        if (far - e > largest_exponent)
            throw Error(ExitCode::scene, name + ": lies more than 2^60 times the size of the scene's geometry away from it");
        needed = std::max(needed, far - comfortable_exponent);
    });
    result.scale = std::ldexp(1.0, -needed);
    return result;
}

} // namespace lanecast
