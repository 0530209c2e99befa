#pragma once
// Scenes to render, and films to compare.

#include "render/ray_support.hpp"
#include "render/renderer.hpp"

#include <functional>

namespace lanecast::test {

/// Every primitive, kind of light and material: mirrors, nested glass, a mirrored mesh, a transmissive ball, planes on two sides.
[[nodiscard]] SceneDescription everything();

/// Primitives of all kinds with materials of all kinds, one to four lights, a camera that looks at them.
[[nodiscard]] SceneDescription random_lit_scene(Random& random, int size);

/// 64 x 48 unless told otherwise.
struct Shot {
    FrameOptions options{64, 48, {0, 0, 0, 0}, 1, 32};
    RenderSettings settings{};
};

[[nodiscard]] Frame shoot(const KernelTable& kernels, const SceneDescription& scene, const Shot& shot);

/// Empty, or the first pixel of `part` that differs in its bits from the same pixel of `whole`.
[[nodiscard]] std::string film_difference(const Film& whole, const Film& part);

/// Every anti-aliasing mode, with its variants.
[[nodiscard]] std::vector<AntiAliasing> anti_aliasings();
[[nodiscard]] const char* name_of(AntiAliasMode mode);

} // namespace lanecast::test
