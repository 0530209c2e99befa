#pragma once
// What a frame says about itself: the table of --stats and the attributes of the EXR file.

#include "render/exr_io.hpp"
#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace lanecast {

struct RenderReport {
    std::string scene; ///< file name without directories
    RenderSettings settings;
    FrameOptions options;
    FrameStats stats;
    std::string isa;
    int width = 0;      ///< rays per vector
    std::string budget; ///< what the settings were picked for, and what was expected; empty: they were given
    double load_seconds = 0, flatten_seconds = 0, build_seconds = 0, write_seconds = 0;
};

/// Time per stage, rays by kind, the tree, memory; docs/command-line.md says what each number means.
[[nodiscard]] std::string stats_table(const RenderReport& report, const SceneArrays& arrays);

/// `volatile_metadata`: also what differs between two runs that give the same pixels.
[[nodiscard]] std::vector<ExrAttribute> exr_attributes(const RenderReport& report, bool volatile_metadata);

} // namespace lanecast
