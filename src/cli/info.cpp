// lanecast info: what a scene holds and what it will cost.

#include "cli/commands.hpp"
#include "cli/info_report.hpp"
#include "cli/print.hpp"
#include "scene/error.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>

namespace lanecast {

double grid_spacing(const SceneArrays& arrays) {
    const float largest = arrays.max_coordinate;
    return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest) /
           arrays.normalisation.scale;
}

void add_info(CLI::App& app, Command& chosen) {
    struct InfoRequest {
        FrameRequest frame;
        bool json = false;
    };
    CLI::App* const command =
        app.add_subcommand("info", "Describe a scene: counts, bounds, memory, tree, what is modelled; renders nothing");
    const auto request = std::make_shared<InfoRequest>();
    add_scene_options(*command, request->frame);
    command->add_flag("--json", request->json, "As JSON, numbers in full");
    add_flatten_options(*command, request->frame);
    command->final_callback([&chosen, request] {
        chosen = [request] {
            RequestedScene scene = load_requested(request->frame);
            const SceneArrays arrays = flatten_requested(request->frame, scene);
            print_result((request->json ? info_json : info_text)(scene, arrays));
            return static_cast<int>(ExitCode::done);
        };
    });
}

} // namespace lanecast
