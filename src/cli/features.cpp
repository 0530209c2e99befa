#include "cli/info_report.hpp"

namespace lanecast {

std::vector<Feature> features_of(const SceneArrays& arrays, const RenderSettings& settings) {
    const auto has = [&](std::uint32_t bit) { return (arrays.features & bit) != 0; };
    const bool shadows = has(feature_lights) && settings.shadows;
    return {
        {"triangles", has(feature_triangles)},
        {"spheres", has(feature_spheres)},
        {"ellipsoids", has(feature_ellipsoids)},
        {"cylinders", has(feature_cylinders)},
        {"cones", has(feature_cones)},
        {"open cones", has(feature_open_cones)},
        {"planes", has(feature_planes)},
        {"lights", has(feature_lights)},
        {"specular", has(feature_specular)},
        {"shadows", shadows},
        {"soft shadows", shadows && has(feature_soft_lights)},
        {"transmissive shadows", shadows && has(feature_transmissive) && settings.transmissive_shadows},
        {"reflection", has(feature_reflective)},
        {"schlick", has(feature_reflective) && settings.schlick},
        {"transmission", has(feature_transmissive)},
        {"refraction", has(feature_refraction)},
        {"anti-aliasing", settings.anti_aliasing.mode != AntiAliasMode::off},
    };
}

} // namespace lanecast
