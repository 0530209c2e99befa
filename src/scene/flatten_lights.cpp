#include "scene/flatten_lights.hpp"

#include "scene/normalise.hpp"
#include "scene/transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanecast {
namespace {

void store(float (&to)[3], const glm::dvec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]) + 0.0f; // no -0
}

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// Inclusive: at 180 degrees everything is lit, however the dot product is rounded; 90 and 60 degrees are exact.
float cos_cutoff(double degrees) {
    if (degrees >= 180) return -2;
    if (degrees == 90) return 0;
    if (degrees == 60) return 0.5f;
    return static_cast<float>(std::cos(radians(degrees)));
}

struct Flatten {
    const Normalisation& normalisation;
    bool soft;
    SceneArrays& arrays;

    void operator()(const AmbientLight&) const {}
    void operator()(const DirectionalLight& light) const {
        LightRecord record{};
        record.kind = LightKind::directional;
        store(record.color, light.color);
        store(record.direction, unit(light.direction));
        record.attenuation[0] = 1;
        record.radius = static_cast<float>(std::sin(radians(light.angle / 2)));
        add(record);
    }
    void operator()(const PointLight& light) const { add(placed(light, LightKind::point)); }
    void operator()(const SpotLight& light) const {
        LightRecord record = placed(light, LightKind::spot);
        store(record.direction, unit(light.direction));
        record.cos_cutoff = cos_cutoff(light.cutoff);
        add(record);
    }

    template <class Light>
    [[nodiscard]] LightRecord placed(const Light& light, LightKind kind) const {
        LightRecord record{};
        record.kind = kind;
        store(record.color, light.color);
        store(record.position, normalised(normalisation, light.position));
        double unit_power = 1;
        for (int i = 0; i < 3; ++i, unit_power /= normalisation.scale) {
            const double coefficient = light.attenuation[static_cast<std::size_t>(i)];
            record.attenuation[i] =
                coefficient == 0 ? 0.0f : static_cast<float>(std::clamp(coefficient * unit_power, -0x1p100, 0x1p100));
        }
        record.radius = static_cast<float>(std::min(light.radius * normalisation.scale, 0x1p40));
        return record;
    }
    void add(const LightRecord& record) const {
        arrays.lights.push_back(record);
        arrays.features |= feature_lights | (soft && record.radius > 0 ? feature_soft_lights : 0);
    }
};

} // namespace

void flatten_lights(const SceneDescription& scene, const RenderSettings& settings, SceneArrays& arrays) {
    glm::dvec3 ambient{0};
    for (const Light& light : scene.lights) {
        std::visit(Flatten{arrays.normalisation, settings.soft_shadows > 0, arrays}, light);
        if (const auto* a = std::get_if<AmbientLight>(&light)) ambient += a->color;
    }
    store(arrays.ambient, settings.ambient ? ambient : glm::dvec3(0));
    store(arrays.background, scene.camera.background);
}

} // namespace lanecast
