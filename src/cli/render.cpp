// lanecast render: a scene in, its pictures out.

#include "cli/commands.hpp"
#include "cli/frame_request.hpp"
#include "cli/interrupt.hpp"
#include "cli/measure/budget_options.hpp"
#include "cli/number_option.hpp"
#include "cli/print.hpp"
#include "cli/progress.hpp"
#include "cli/render_report.hpp"
#include "cli/write_pictures.hpp"
#include "render/dispatch.hpp"
#include "render/scrub.hpp"
#include "scene/error.hpp"
#include "scene/scene_format.hpp"
#include "scene/scene_message.hpp"
#include "scene/text_tools.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

using Clock = std::chrono::steady_clock;

struct RenderRequest {
    FrameRequest frame;
    std::optional<std::string> output;
    std::optional<Tile> crop;
    std::optional<int> tile_size;
    View view = default_view;
    double exposure = 0;
    trade::Budget budget;
    bool float_pixels = false, stats = false, no_volatile_metadata = false;
};

constexpr KeySpec tile_key{.name = "tile", .kind = ValueKind::whole, .range = {.low = 1, .high = 64}};
constexpr KeySpec exposure_key{.name = "exposure", .range = {.low = -100, .high = 100}};

void add_options(CLI::App& command, RenderRequest& request) {
    add_scene_options(command, request.frame);
    command
        .add_option("-o,--output", request.output,
                    "Name of the pictures, which gets .exr and .png; with one of these at its end only that file is written. "
                    "Default: the scene's name, in the current directory")
        ->type_name("NAME");
    command
        .add_option_function<std::string>(
            "--crop", [&](const std::string& text) { request.crop = parse_crop("--crop", text); },
            "Render only the pixels X0 <= x < X1, Y0 <= y < Y1, counted from the top left corner")
        ->type_name("X0,Y0,X1,Y1");
    command
        .add_option_function<std::string>(
            "--view",
            [&](const std::string& text) {
                const std::optional<View> view = view_from_name(text);
                if (!view)
                    throw CLI::ValidationError("--view", "must be plain, srgb, reinhard, aces or neutral, got '" + text + "'");
                request.view = *view;
            },
            "How the PNG shows the radiance; default srgb")
        ->type_name("plain|srgb|reinhard|aces|neutral");
    add_number_option(command, "--exposure", "The PNG shows the radiance times 2^EV; default 0", exposure_key, [&](double value) {
        request.exposure = value;
    })->type_name("EV");
    command.add_flag("--float", request.float_pixels, "32-bit floats in the EXR instead of 16-bit halves");
    command.add_flag("--no-volatile-metadata", request.no_volatile_metadata,
                     "Leave out of the EXR what differs from run to run: ISA, threads, times, ray counts, host, date");
    command.add_flag("--stats", request.stats, "Print where the time went and which rays were traced");
    add_number_option(command, "--tile",
                      "Edge of a tile in pixels, 1 to 64; default 64, or 32 in small pictures. The picture does not depend on it",
                      tile_key, [&](double value) { request.tile_size = static_cast<int>(value); });
    trade::add_budget_options(command, request.budget);
    add_frame_options(command, request.frame);
    add_flatten_options(command, request.frame);
}

[[nodiscard]] FrameOptions requested_frame(const RenderRequest& request, const RequestedScene& scene) {
    FrameOptions options = frame_options(request.frame, scene);
    if (request.crop) options.crop = *request.crop;
    if (options.crop.x1 > options.width || options.crop.y1 > options.height)
        throw Error(ExitCode::usage, "--crop: must lie in the image, " + std::to_string(options.width) + "x" +
                                         std::to_string(options.height) + ", and reaches to " + std::to_string(options.crop.x1) +
                                         "," + std::to_string(options.crop.y1));
    options.tile_size = request.tile_size.value_or(default_tile_size(options));
    return options;
}

[[nodiscard]] Frame render_with_progress(const RenderRequest& request, const KernelTable& kernels, const SceneArrays& arrays,
                                         const RequestedScene& scene, const FrameOptions& options) {
    if (request.frame.quiet) return render_frame(kernels, arrays, scene.description.camera, scene.settings, options);
    ProgressDisplay display;
    return render_frame(kernels, arrays, scene.description.camera, scene.settings, options,
                        [&](double done, std::uint64_t rays) { display.show(done, rays); });
}

/// Values that the files cannot hold. Those that are not finite make a wrong picture, which --quiet does not hide.
void warn_of_values(const RenderRequest& request, Film& film) {
    const auto warn = [&](std::uint64_t values, const std::string& what, bool hidden) {
        if (values == 0) return;
        const std::string text = counted(values, "value") + " of the picture " + what;
        const std::filesystem::path scene = request.frame.scene;
        if (request.frame.strict)
            throw Error(ExitCode::scene, message_in_scene(scene, "error", text + std::string(strict_suffix)));
        if (!hidden) print_message(message_in_scene(scene, "warning", text));
    };
    warn(scrub(film), "overflowed; infinity became the largest number, NaN became 0", false);
    warn(request.float_pixels ? 0 : count_beyond_half(film), "had to be clamped to 65504, the largest half; --float keeps them",
         request.frame.quiet);
}

[[nodiscard]] PictureOptions picture_options(const RenderRequest& request, const RequestedScene& scene,
                                             const RenderReport& report) {
    PictureOptions options;
    const double half_field = scene.description.camera.field * std::numbers::pi / 360;
    options.exr.screen_window_width = static_cast<float>(2 * std::tan(half_field) * report.options.width / report.options.height);
    options.exr.float_pixels = request.float_pixels;
    options.threads = thread_count(request.frame);
    options.exr.attributes = exr_attributes(report, !request.no_volatile_metadata);
    options.view = request.view;
    options.exposure = request.exposure;
    return options;
}

void print_summary(const PictureNames& names, const RenderReport& report, const Film& film) {
    std::string files = names.exr.empty() ? "" : printable_path(names.exr);
    if (!names.png.empty()) files += (files.empty() ? "" : " and ") + printable_path(names.png);
    print_message("wrote " + files + " (" + std::to_string(film.width) + "x" + std::to_string(film.height) + ", " +
                  short_count(static_cast<double>(ray_count(report.stats.tiles))) + " rays in " +
                  short_seconds(report.stats.seconds) + ")");
}

int render(RenderRequest request) {
    RequestedScene scene = load_requested(request.frame);
    FrameOptions options = requested_frame(request, scene);
    static_cast<void>(find_kernels(request.frame.isa, scene.settings.precision)); // a name that does not exist ends here
    if (request.output && request.output->empty()) throw Error(ExitCode::usage, "--output: the name is empty");
    const PictureNames names = picture_names(request.output.value_or(""), request.frame.scene);
    probe_outputs(names); // before the work, not after it
    const trade::FixedKnobs fixed = trade::fixed_by(request.frame, request.float_pixels);
    const bool picks = is_given(request.budget);
    const SceneArrays arrays =
        picks ? trade::flatten_for_trials(request.frame, scene, fixed) : flatten_requested(request.frame, scene);

    std::string budget;
    if (picks) {
        const trade::Bench bench{&arrays, &scene.description.camera, request.frame.isa, options, {}};
        const trade::Choice base{scene.settings, request.float_pixels};
        const trade::Pick pick = trade::pick_and_say(bench, base, fixed, request.budget, request.frame.quiet);
        scene.settings = pick.choice.settings;
        request.float_pixels = pick.choice.float_file;
        budget = trade::record_of(pick, request.budget);
    }
    const KernelTable& kernels = find_kernels(
        scene.settings.precision == Precision::reference && picks ? "auto" : request.frame.isa, scene.settings.precision);
    const InterruptScope interrupt;
    options.stop = &interrupt.stop();
    Frame frame = render_with_progress(request, kernels, arrays, scene, options);
    interrupt.check();
    warn_of_values(request, frame.film);

    RenderReport report{.scene = std::filesystem::path(request.frame.scene).filename().string(),
                        .settings = scene.settings,
                        .options = options,
                        .stats = frame.stats,
                        .isa = kernels.isa,
                        .width = kernels.width,
                        .budget = budget,
                        .load_seconds = scene.load_seconds,
                        .flatten_seconds = arrays.bake_seconds,
                        .build_seconds = arrays.build_seconds};
    const auto begin = Clock::now();
    write_pictures(names, frame.film, picture_options(request, scene, report), [&] { interrupt.check(); });
    report.write_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!request.frame.quiet) print_summary(names, report, frame.film);
    if (request.stats) print_result(stats_table(report, arrays));
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_render(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("render", "Render a scene to an EXR and a PNG");
    const auto request = std::make_shared<RenderRequest>();
    add_options(*command, *request);
    command->final_callback([&chosen, request] { chosen = [request] { return render(*request); }; });
}

} // namespace lanecast
