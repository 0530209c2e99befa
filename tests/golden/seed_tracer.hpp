#pragma once
// A scalar, recursive Whitted tracer that shares nothing with the renderer but the description of the scene. Without faults it is
// a second opinion on what the picture means; with them it is the program behind the reference pictures.

#include "render/film.hpp"
#include "scene/description.hpp"

#include "golden/seed_faults.hpp"

#include <cstdint>
#include <span>

namespace lanecast::test {

/// Of the settings it knows depth, schlick and the anti-aliasing modes off and cross; of the camera field, near and background:
/// the eye is at the origin and looks down -z. No soft or transmissive shadows.
/// `wanted`, where not empty: a byte per pixel, row by row; the others stay black.
[[nodiscard]] Film render_seed(const SceneDescription& description, const RenderSettings& settings, const SeedFaults& faults,
                               int width, int height, int threads, std::span<const std::uint8_t> wanted = {});

} // namespace lanecast::test
