#include "render/camera.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace lanecast {
namespace {

void copy(const glm::dvec3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

} // namespace

CameraRecord make_camera(const Camera& camera, const Normalisation& normalisation, int width, int height) {
    const glm::dvec3 forward = glm::normalize(camera.look_at - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    CameraRecord record{};
    copy((camera.position - normalisation.centre) * normalisation.scale, record.org);
    copy(forward, record.forward);
    copy(right, record.right);
    copy(up, record.up);
    record.half_width = static_cast<float>(width) * 0.5f;
    record.half_height = static_cast<float>(height) * 0.5f;
    record.pixel = static_cast<float>(2.0 * std::tan(camera.field * std::numbers::pi / 360.0) / height);
    record.near = static_cast<float>(camera.near * normalisation.scale);
    return record;
}

} // namespace lanecast
