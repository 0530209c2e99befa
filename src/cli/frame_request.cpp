#include "cli/frame_request.hpp"

#include "cli/number_option.hpp"
#include "cli/print.hpp"
#include "scene/error.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene_message.hpp"
#include "scene/thread_count.hpp"

#include <chrono>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

constexpr KeySpec threads_key{.name = "threads", .kind = ValueKind::whole, .range = {.low = 1, .high = 1024}};

SceneArrays flatten_or_say_where(const FrameRequest& request, const RequestedScene& scene) {
    try {
        return flatten(scene.description, scene.settings, thread_count(request));
    } catch (const Error& error) { // flatten knows the description, not the file
        throw Error(error.code(), message_in_scene(request.scene, "error", error.what()));
    }
}

} // namespace

void add_scene_options(CLI::App& command, FrameRequest& request) {
    command.add_option("scene", request.scene, "Scene file (JSON)")->required()->type_name("FILE");
    command.add_flag("--strict", request.strict, "Warnings are errors");
    command.add_flag("-q,--quiet", request.quiet,
                     "Only errors and what was asked for: no warnings (but of values that overflowed), no progress, no summary");
}

void add_frame_options(CLI::App& command, FrameRequest& request) {
    const auto set_size = [&request](const std::string& text) { request.size = parse_size("--size", text); };
    command
        .add_option_function<std::string>("--size", set_size, "Size of the image in pixels; default: the scene's `resolution`")
        ->type_name("WxH");
    command.add_option("--isa", request.isa, "Instruction set: auto, scalar, sse4.2, avx2 or avx512")->type_name("NAME");
}

void add_flatten_options(CLI::App& command, FrameRequest& request) {
    add_number_option(command, "--threads", "Threads; default: the CPUs this process may use", threads_key,
                      [&request](double value) { request.threads = static_cast<int>(value); });
    add_settings_options(command, request.changes);
}

RequestedScene load_requested(const FrameRequest& request) {
    const auto begin = std::chrono::steady_clock::now();
    LoadedScene loaded = load_scene(request.scene, {.strict = request.strict});
    RequestedScene scene;
    scene.description = std::move(loaded.description);
    scene.settings = changed(scene.description.render, request.changes);
    scene.warnings = std::move(loaded.warnings);
    if (!request.quiet)
        for (const std::string& warning : scene.warnings) print_message(warning);
    scene.load_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return scene;
}

SceneArrays flatten_requested(const FrameRequest& request, RequestedScene& scene) {
    SceneArrays arrays = flatten_or_say_where(request, scene);
    if (request.strict && !arrays.warnings.empty())
        throw Error(ExitCode::scene, message_in_scene(request.scene, "error", arrays.warnings.front()));
    for (const std::string& text : arrays.warnings) {
        scene.warnings.push_back(message_in_scene(request.scene, "warning", text));
        if (!request.quiet) print_message(scene.warnings.back());
    }
    return arrays;
}

FrameOptions frame_options(const FrameRequest& request, const RequestedScene& scene) {
    const std::array<int, 2> size = request.size.value_or(scene.description.camera.resolution);
    FrameOptions options;
    options.width = size[0];
    options.height = size[1];
    options.threads = thread_count(request);
    return options;
}

int thread_count(const FrameRequest& request) { return request.threads > 0 ? request.threads : default_thread_count(); }

} // namespace lanecast
