#pragma once
// What `render`, `check`, `info` and `pick` have in common: a scene, its settings as changed by the command line, and how to run
// them.

#include "cli/settings_options.hpp"
#include "render/renderer.hpp"
#include "scene/description.hpp"

#include <array>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace lanecast {

struct FrameRequest {
    std::string scene; ///< file
    bool strict = false;
    bool quiet = false; ///< no warnings
    SettingsChanges changes;
    std::optional<std::array<int, 2>> size;
    int threads = 0; ///< 0: as many as there are CPUs for us
    std::string isa = "auto";
};

/// The positional scene, --strict, --quiet.
void add_scene_options(CLI::App& command, FrameRequest& request);
/// --size, --isa.
void add_frame_options(CLI::App& command, FrameRequest& request);
/// --threads and all switches.
void add_flatten_options(CLI::App& command, FrameRequest& request);

struct RequestedScene {
    SceneDescription description;
    RenderSettings settings;
    std::vector<std::string> warnings; ///< so far
    double load_seconds = 0;
};

/// Prints warnings. Throws Error.
[[nodiscard]] RequestedScene load_requested(const FrameRequest& request);

/// flatten, with its warnings printed, or thrown under --strict.
[[nodiscard]] SceneArrays flatten_requested(const FrameRequest& request, RequestedScene& scene);

/// Size and threads; the rest as it is by default.
[[nodiscard]] FrameOptions frame_options(const FrameRequest& request, const RequestedScene& scene);

[[nodiscard]] int thread_count(const FrameRequest& request);

} // namespace lanecast
