#pragma once
// The objects with their transforms composed and their places in the numbering decided.

#include "scene/bounds.hpp"
#include "scene/description.hpp"
#include "scene/scene_view.hpp"
#include "scene/transform.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lanecast {

struct FlatObject {
    const Object* object = nullptr;
    std::uint32_t index = 0; ///< in the file
    PrimitiveKind kind = PrimitiveKind::triangle;
    AffineTransform world_from_object;
    bool mirrored = false;
    std::uint32_t first_scene_id = 0; ///< of its triangles in mesh order, or of itself
    std::size_t first_ref = 0;        ///< among all bounded primitives in file order
    std::size_t first_vertex = 0;     ///< among all vertices of meshes
};

struct FlatObjects {
    std::vector<FlatObject> objects; ///< in file order, planes included
    std::size_t refs = 0;            ///< bounded primitives
    std::size_t vertices = 0;
};

/// Throws Error (scene) for a transform that is not finite, Error (memory) for more primitives than 32 bits count.
[[nodiscard]] FlatObjects prepare_objects(const SceneDescription& scene);

/// `/objects/3 ("name")`, for messages.
[[nodiscard]] std::string label(const FlatObject& object);

} // namespace lanecast
