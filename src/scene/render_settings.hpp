#pragma once
// The switches a scene may carry in its `render` block and the command line may override.

#include "scene/precision.hpp"

namespace lanecast {

/// The tree; the picture is the same with each.
enum class BvhMode {
    off,      ///< every ray is tested against every primitive, for checking
    standard, ///< `default`
    quality,  ///< with spatial splits: takes several times longer to build
};

enum class AntiAliasMode {
    off,
    cross, ///< four more rays per pixel that hits something: up, down, left, right; the five are averaged
    grid,  ///< samples x samples rays per pixel
    edge,  ///< samples x samples rays in pixels that an edge crosses, five beside them, one elsewhere
};

struct AntiAliasing {
    AntiAliasMode mode = AntiAliasMode::off;
    int samples = 4;           ///< per side, for grid and edge; 1 to 64
    double offset = 1.0 / 3.0; ///< of the cross, in pixels; > 0, at most 16
    bool planes = true;        ///< whether the cross is also drawn for pixels whose centre ray hits a plane
};

struct RenderSettings {
    bool ambient = true;
    bool diffuse = true;
    bool specular = true;
    bool shadows = true;
    bool transmissive_shadows = false; ///< each crossed surface multiplies the light by its `transmissive`
    bool reflections = true;
    bool transmission = true; ///< off: every material is opaque
    bool refraction = true;   ///< off: transmitted rays go straight through
    bool schlick = false;
    bool planes = true; ///< off: infinite planes are left out of the scene
    BvhMode bvh = BvhMode::standard;
    AntiAliasing anti_aliasing;
    int soft_shadows = 0; ///< shadow rays per light that has a `radius` or an `angle`; 0: hard shadows; at most 1024
    int depth = 8;        ///< the last level that is traced; the camera ray is level 0; at most 1024
    double cutoff = 0;    ///< a child ray whose weight is below this is not traced; 0 to 1
    Precision precision = Precision::balanced;
};

} // namespace lanecast
