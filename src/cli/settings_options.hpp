#pragma once
// Every switch of a scene's `render` block as options of the command line. The names are those of the block with - for _.

#include "scene/render_settings.hpp"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lanecast {

/// What the user gave, as changes to the scene's settings.
using SettingsChanges = std::vector<std::function<void(RenderSettings&)>>;

/// `changes` must outlive the parse.
void add_settings_options(CLI::App& command, SettingsChanges& changes);

/// The command line with `--bvh quality` as one word, `--bvh=quality`: `--bvh` alone is a switch, and a scene may follow it.
[[nodiscard]] std::vector<std::string> join_bvh_words(int argc, const char* const* argv);

[[nodiscard]] RenderSettings changed(RenderSettings settings, const SettingsChanges& changes);

/// As one line of JSON that a scene's `render` block accepts.
[[nodiscard]] std::string settings_json(const RenderSettings& settings);

} // namespace lanecast
