#include "cli/selftest/objects.hpp"

namespace lanecast::selftest {

Object make_object(const Shape& shape, const std::vector<Transformation>& transformations, const Material& material) {
    Object object;
    object.shape = shape;
    object.transformations = transformations;
    object.material = material;
    return object;
}

void add_object(SceneDescription& scene, const Shape& shape, const std::vector<Transformation>& transformations,
                const Material& material) {
    scene.objects.push_back(make_object(shape, transformations, material));
}

} // namespace lanecast::selftest
