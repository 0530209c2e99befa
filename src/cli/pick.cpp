// lanecast pick: why does this pixel have this colour?

#include "cli/commands.hpp"
#include "cli/frame_request.hpp"
#include "cli/pick_report.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "scene/error.hpp"

#include <memory>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

struct PickRequest {
    FrameRequest frame;
    int x = 0, y = 0;
    bool json = false;
};

int pick(const PickRequest& request) {
    RequestedScene scene = load_requested(request.frame);
    const FrameOptions options = frame_options(request.frame, scene);
    if (request.x < 0 || request.y < 0 || request.x >= options.width || request.y >= options.height)
        throw Error(ExitCode::usage, "pick: pixel (" + std::to_string(request.x) + ", " + std::to_string(request.y) +
                                         ") is not in the image, " + std::to_string(options.width) + "x" +
                                         std::to_string(options.height));
    const KernelTable& kernels = find_kernels(request.frame.isa, scene.settings.precision);
    const SceneArrays arrays = flatten_requested(request.frame, scene);
    const PixelTrace trace =
        trace_pixel(kernels, arrays, scene.description.camera, scene.settings, options, request.x, request.y);
    const PickedPixel pixel{.x = request.x,
                            .y = request.y,
                            .width = options.width,
                            .height = options.height,
                            .tree = pixel_tree(trace, arrays, scene.description)};
    print_result((request.json ? pick_json : pick_text)(pixel, scene.description));
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_pick(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("pick", "Print the whole ray tree of a pixel");
    const auto request = std::make_shared<PickRequest>();
    add_scene_options(*command, request->frame);
    command->add_option("x", request->x, "Pixels from the left, from 0")->required()->type_name("X");
    command->add_option("y", request->y, "Pixels from the top, from 0")->required()->type_name("Y");
    command->add_flag("--json", request->json, "As JSON, numbers in full");
    add_frame_options(*command, request->frame);
    add_flatten_options(*command, request->frame);
    command->final_callback([&chosen, request] { chosen = [request] { return pick(*request); }; });
}

} // namespace lanecast
