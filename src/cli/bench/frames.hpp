#pragma once
// Whole frames of a scene: where their time goes, and what a second thread gives.

#include <string>

namespace lanecast::bench {

struct FramesRequest {
    std::string scene; ///< file
    std::string isa = "auto";
    std::string precision; ///< empty: the scene's
    int width = 1920, height = 1080;
    int pairs = 15; ///< frames with one thread and with `threads`, in turn
    int threads = 2;
    int warm_up = 1;
};

/// Throws Error.
[[nodiscard]] std::string measure_frames(const FramesRequest& request);

} // namespace lanecast::bench
