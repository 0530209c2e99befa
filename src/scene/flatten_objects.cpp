#include "scene/flatten_objects.hpp"

#include "scene/bvh_refs.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <limits>

namespace lanecast {
namespace {

PrimitiveKind kind_of_shape(const Shape& shape, const glm::dmat3& linear) {
    if (std::holds_alternative<Mesh>(shape)) return PrimitiveKind::triangle;
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return cylinder->capped ? PrimitiveKind::cylinder : PrimitiveKind::open_cone;
    if (const auto* cone = std::get_if<Cone>(&shape)) return cone->capped ? PrimitiveKind::cone : PrimitiveKind::open_cone;
    if (std::holds_alternative<Plane>(shape)) return PrimitiveKind::plane;
    return classify(linear) == TransformClass::similarity ? PrimitiveKind::sphere : PrimitiveKind::ellipsoid;
}

} // namespace

std::string label(const FlatObject& object) {
    const std::string place = "/objects/" + std::to_string(object.index);
    return object.object->name.empty() ? place : place + " (\"" + printable(object.object->name) + "\")";
}

FlatObjects prepare_objects(const SceneDescription& scene) {
    if (scene.objects.size() >= std::size_t{1} << (32 - source_object_shift))
        throw Error(ExitCode::memory, "the scene has too many objects");
    FlatObjects result;
    result.objects.reserve(scene.objects.size());
    std::size_t scene_ids = 0;
    for (const Object& object : scene.objects) {
        FlatObject flat;
        flat.object = &object;
        flat.index = static_cast<std::uint32_t>(result.objects.size());
        flat.world_from_object = compose(object.transformations);
        if (!is_finite(flat.world_from_object.linear) || !is_finite(flat.world_from_object.translation))
            throw Error(ExitCode::scene, label(flat) + ": its transformations overflow");
        flat.kind = kind_of_shape(object.shape, flat.world_from_object.linear);
        flat.mirrored = is_mirroring(flat.world_from_object.linear);
        flat.first_scene_id = static_cast<std::uint32_t>(scene_ids);
        flat.first_ref = result.refs;
        flat.first_vertex = result.vertices;
        std::size_t primitives = 1;
        if (const auto* mesh = std::get_if<Mesh>(&object.shape)) {
            primitives = mesh->triangles.size();
            result.vertices += mesh->positions.size();
        }
        scene_ids += primitives;
        if (flat.kind != PrimitiveKind::plane) result.refs += primitives;
        if (scene_ids > std::numeric_limits<std::uint32_t>::max())
            throw Error(ExitCode::memory, "the scene has too many primitives");
        result.objects.push_back(flat);
    }
    return result;
}

} // namespace lanecast
