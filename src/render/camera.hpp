#pragma once
// The camera of the description as the record that kernels read.

#include "render/kernel_table.hpp"
#include "scene/description.hpp"
#include "scene/scene_arrays.hpp"

namespace lanecast {

/// For an image of width x height pixels: square pixels, `field` spans the height.
[[nodiscard]] CameraRecord make_camera(const Camera& camera, const Normalisation& normalisation, int width, int height);

} // namespace lanecast
