// lanecast check: is this scene valid?

#include "cli/commands.hpp"
#include "cli/frame_request.hpp"
#include "cli/print.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <memory>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

int check(const FrameRequest& request) {
    RequestedScene scene = load_requested(request);
    static_cast<void>(flatten_requested(request, scene)); // finds what only the arrays show: range, ill-conditioned transforms
    if (request.quiet) return static_cast<int>(ExitCode::done);
    const SceneDescription& description = scene.description;
    print_result(printable_path(request.scene) + ": ok, " + counted(description.objects.size(), "object") + ", " +
                 counted(description.lights.size(), "light") +
                 (scene.warnings.empty() ? "" : ", " + counted(scene.warnings.size(), "warning")) + "\n");
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_check(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("check", "Validate a scene and its meshes; renders nothing");
    const auto request = std::make_shared<FrameRequest>();
    add_scene_options(*command, *request);
    command->final_callback([&chosen, request] { chosen = [request] { return check(*request); }; });
}

} // namespace lanecast
