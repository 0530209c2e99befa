#pragma once
// JSON in, a checked SceneDescription out. Every fault names file, line, column and place: see docs/scene-format.md.

#include "scene/description.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

struct LoadedScene {
    SceneDescription description;
    std::vector<std::string> warnings; ///< each formatted as `file:line:column: warning: /place: text`, source line and caret
};

struct LoadOptions {
    bool strict = false; ///< the first warning is an error
};

/// Reads the scene and the mesh files it names, relative to it. Throws Error: ExitCode::scene for the JSON and what it
/// says, ExitCode::asset for mesh files. The message is one line, then the source line, then a caret.
[[nodiscard]] LoadedScene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// The same for a text in memory; `name` stands for the file in messages, meshes are looked for in `directory`.
[[nodiscard]] LoadedScene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                                      const LoadOptions& options = {});

} // namespace lanecast
