#pragma once
// A pixel's ray tree as text and as JSON.

#include "cli/pixel_tree.hpp"

#include <string>

namespace lanecast {

struct PickedPixel {
    int x = 0, y = 0, width = 0, height = 0; ///< of an image of width x height
    PixelTree tree;
};

/// Indentation shows which ray came from which.
[[nodiscard]] std::string pick_text(const PickedPixel& pixel, const SceneDescription& scene);
/// Numbers in full; children as nested lists.
[[nodiscard]] std::string pick_json(const PickedPixel& pixel, const SceneDescription& scene);

} // namespace lanecast
