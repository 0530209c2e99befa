#pragma once
// The scene as the file says it: right-handed world, y up, lengths in scene units, angles in degrees, linear Rec.709
// colours. Mirrors the JSON and knows nothing of rendering. Everything in it has been checked by `load_scene`.

#include "scene/render_settings.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast {

struct Rotation {
    glm::dvec3 axis{0, 1, 0}; ///< any length but zero
    double degrees = 0;       ///< right-handed about `axis`
};
struct Scale {
    glm::dvec3 scale{1}; ///< no component is zero; negative ones mirror
};
struct Translation {
    glm::dvec3 translate{0};
};
using Transformation = std::variant<Rotation, Scale, Translation>; ///< applied to the object first to last

struct Material {
    glm::dvec3 ambient{0};
    glm::dvec3 diffuse{0};
    glm::dvec3 specular{0};
    glm::dvec3 reflective{0};
    glm::dvec3 transmissive{0};
    double shininess = 1;
    double refraction = 0; ///< index of refraction; 0: light goes straight through
};

struct Sphere {
    double radius = 1;
    glm::dvec3 position{0}; ///< applied before the transformations
};
/// Axis y, centred on the origin.
struct Cylinder {
    double radius = 1;
    double height = 1;
    bool capped = true;
};
/// A cone or a truncated one: axis y, its ends at -height / 2 and height / 2.
struct Cone {
    double base_radius = 1; ///< below
    double apex_radius = 0; ///< above
    double height = 1;
    bool capped = true;
};
/// Infinite; the side the normal points to is outside.
struct Plane {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 1, 0}; ///< any length but zero
};
struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into `positions`, checked
    std::vector<Material> materials;                     ///< of an OBJ's MTL; empty: the object's material
    std::vector<std::uint32_t> triangle_material;        ///< per triangle, an index into `materials`; empty with it
    std::string file;                                    ///< empty for triangles given in the scene
};
using Shape = std::variant<Sphere, Cylinder, Cone, Plane, Mesh>;

struct Object {
    Shape shape;
    std::vector<Transformation> transformations; ///< empty for planes
    Material material;
    std::string name; ///< may be empty
};

struct AmbientLight {
    glm::dvec3 color{0};
};
struct DirectionalLight {
    glm::dvec3 color{0};
    glm::dvec3 direction{0, -1, 0}; ///< where the light travels; any length but zero
    double angle = 0;               ///< full angle of the source in degrees, for soft shadows; 0 to 180
};
struct PointLight {
    glm::dvec3 color{0};
    glm::dvec3 position{0};
    std::array<double, 3> attenuation{1, 0, 0}; ///< constant, linear, quadratic; the light is divided by c + l d + q d^2
    double radius = 0;                          ///< of the source, for soft shadows
};
struct SpotLight {
    glm::dvec3 color{0};
    glm::dvec3 position{0};
    glm::dvec3 direction{0, -1, 0};
    double cutoff = 45; ///< half angle of the cone in degrees, 0 < cutoff <= 180; hard edge, inclusive
    std::array<double, 3> attenuation{1, 0, 0};
    double radius = 0;
};
using Light = std::variant<AmbientLight, DirectionalLight, PointLight, SpotLight>;

struct Camera {
    double field = 60; ///< vertical field of view in degrees, 0 < field < 180
    glm::dvec3 background{0};
    glm::dvec3 position{0};
    glm::dvec3 look_at{0, 0, -1};
    glm::dvec3 up{0, 1, 0};
    double near = 0;                         ///< clip distance along the view axis, of camera rays only
    std::array<int, 2> resolution{512, 512}; ///< width, height
};

struct SceneDescription {
    std::string file; ///< as the user named it; empty for scenes made in memory
    Camera camera;
    std::vector<Object> objects;
    std::vector<Light> lights; ///< at most one is ambient
    RenderSettings render;
};

} // namespace lanecast
