#pragma once
// The owner of the flattened scene, and its view.

#include "scene/aligned_bytes.hpp"
#include "scene/description.hpp"
#include "scene/scene_view.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lanecast {

/// p_normalised = (p_world - centre) * scale; scale is a power of two.
struct Normalisation {
    glm::dvec3 centre{0};
    double scale = 1;
    bool exact = true; ///< false: centring rounded a coordinate
};

struct SceneArrays {
    AlignedBytes arena;
    std::size_t arena_bytes = 0;
    std::vector<std::uint64_t> leaves;
    std::vector<TriangleRecord> triangles;
    std::vector<SphereRecord> spheres;
    std::vector<AffineRecord> affines;
    std::vector<AffineShadingRecord> affine_shading;
    std::vector<PlaneRecord> planes;
    std::vector<std::uint32_t> scene_id;
    std::vector<std::uint32_t> object;
    std::vector<std::uint32_t> material;
    std::vector<std::uint32_t> shared_slots;
    std::vector<MaterialRecord> materials;
    std::vector<LightRecord> lights;
    std::uint32_t first_slot[primitive_kind_count + 1] = {};
    std::uint32_t features = 0;
    float ambient[3] = {};
    float background[3] = {};
    float max_coordinate = 0;

    Normalisation normalisation;
    glm::dvec3 bounds_min{0}, bounds_max{0}; ///< of the bounded geometry, in world units; min > max when there is none
    std::uint32_t degenerate_triangles = 0;  ///< dropped
    std::vector<std::string> warnings; ///< dropped triangles, ill-conditioned transforms, objects too small for the float grid
    double bake_seconds = 0;           ///< transforms, records
    double build_seconds = 0;          ///< the tree
};

/// Valid while `arrays` lives and is not changed.
[[nodiscard]] SceneView view(const SceneArrays& arrays) noexcept;

/// Bytes held, the arena included.
[[nodiscard]] std::size_t memory_bytes(const SceneArrays& arrays) noexcept;

} // namespace lanecast
