#pragma once
// A pixel's ray tree in the words of the scene: world units, objects and lights as the file has them.

#include "render/pick.hpp"
#include "scene/description.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lanecast {

using Triple = std::array<double, 3>;

struct LightShare {
    int light = 0; ///< index in the file
    std::array<float, 3> visibility{}, color{};
};

struct RayNode {
    RayKind kind = RayKind::primary;
    int level = 0;
    Triple org{}, dir{};                               ///< world; dir is unit
    std::optional<int> object;                         ///< index in the file; none: the ray left the scene
    std::optional<long> triangle;                      ///< of a mesh, in mesh order
    double distance = 0;                               ///< world units, of hits
    Triple point{}, normal{};                          ///< the normal is unit and faces the ray
    bool inside = false;                               ///< the surface was hit from its inside
    std::array<float, 3> ambient{};                    ///< ambient term
    std::vector<LightShare> lights;                    ///< that the surface faces and that reach this far
    std::array<float, 3> color{};                      ///< of the ray, children included
    float fresnel = 0;                                 ///< of the reflection
    std::array<float, 3> reflective{}, transmissive{}; ///< of the material
    std::vector<std::size_t> children;                 ///< in the tree's list
};

struct PixelTree {
    std::vector<RayNode> rays; ///< the camera ray first
    std::array<float, 3> color{};
};

[[nodiscard]] PixelTree pixel_tree(const PixelTrace& trace, const SceneArrays& arrays, const SceneDescription& scene);

} // namespace lanecast
