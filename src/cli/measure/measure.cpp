// lanecast measure: what each knob costs and gives on a scene, against the reference.

#include "cli/commands.hpp"
#include "cli/frame_request.hpp"
#include "cli/interrupt.hpp"
#include "cli/machine.hpp"
#include "cli/measure/budget_options.hpp"
#include "cli/measure/report.hpp"
#include "cli/number_option.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "render/output_file.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

using namespace trade;

struct MeasureRequest {
    FrameRequest frame;
    bool quick = false;
    std::optional<int> reference_samples;
    ExperimentOptions experiment;
    std::string json, html;
    std::vector<std::string> plots;
};

constexpr double quick_seconds = 8; ///< about a fifth of the whole
/// Per side of a pixel. 11 has no sample but the centre in common with any of the choices.
constexpr int usual_samples = 16, quick_samples = 11;

constexpr KeySpec tiles_key{.name = "tiles", .kind = ValueKind::whole, .range = {.low = 1, .high = 65536}};
constexpr KeySpec repetitions_key{.name = "repetitions", .kind = ValueKind::whole, .range = {.low = 1, .high = 1000}};
constexpr KeySpec samples_key{.name = "reference samples", .kind = ValueKind::whole, .range = {.low = 2, .high = 64}};
constexpr KeySpec rays_key{.name = "rays", .kind = ValueKind::whole, .range = {.low = 1, .high = 1 << 24}};

/// Before the work, not after it.
void probe_outputs(const MeasureRequest& request) {
    for (const std::string& plot : request.plots)
        if (!bench::is_png(plot) && lower_case(std::filesystem::path(plot).extension().string()) != ".svg")
            throw Error(ExitCode::usage, "--plot: " + printable_path(plot) + ": a plot is an .svg or a .png");
    std::vector<std::string> files{request.json, request.html};
    files.insert(files.end(), request.plots.begin(), request.plots.end());
    for (const std::string& file : files)
        if (!file.empty()) const OutputFile probe(file);
}

int measure(const MeasureRequest& request) {
    RequestedScene scene = load_requested(request.frame);
    static_cast<void>(find_kernels(request.frame.isa, Precision::balanced)); // a name that does not exist ends here
    probe_outputs(request);
    ExperimentOptions options = request.experiment;
    options.fixed = fixed_by(request.frame, false);
    if (request.quick) options.seconds = quick_seconds;
    options.truth_samples = request.reference_samples.value_or(request.quick ? quick_samples : usual_samples);
    if (!request.frame.quiet) options.say = [](const std::string& text) { print_message("lanecast measure: " + text); };
    const SceneArrays arrays = flatten_for_trials(request.frame, scene, options.fixed);

    Bench bench;
    bench.scene = &arrays;
    bench.camera = &scene.description.camera;
    bench.isa = request.frame.isa;
    bench.options = frame_options(request.frame, scene);
    Report report = run_experiment(bench, {scene.settings, false}, options);
    report.scene = std::filesystem::path(request.frame.scene).filename().string();
    report.cpu = cpu_name();
    report.compiler = compiler_name();

    const InterruptScope interrupt; // files are written whole
    if (!request.json.empty()) write_file(request.json, json_report(report));
    if (!request.html.empty()) write_file(request.html, html_report(report));
    for (const std::string& file : request.plots) bench::write_drawing(file, plot(report));
    interrupt.check();
    print_result(text_report(report));
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_measure(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("measure", "Measure what each knob costs and gives on a scene");
    const auto request = std::make_shared<MeasureRequest>();
    MeasureRequest& r = *request;
    add_scene_options(*command, r.frame);
    CLI::Option* const quick = command->add_flag("--quick", r.quick, "As many tiles as can be measured in about a minute");
    add_number_option(*command, "--tiles", "Only N tiles of 32x32 pixels, spread over the frame", tiles_key, [&r](double v) {
        r.experiment.tiles = static_cast<std::size_t>(v);
    })->excludes(quick);
    add_number_option(*command, "--repetitions", "Of which the median time counts; default 5, with --quick at most",
                      repetitions_key, [&r](double v) { r.experiment.repetitions = static_cast<int>(v); });
    add_number_option(*command, "--reference-samples",
                      "Per side of a pixel of the reference picture; default 16, with --quick 11", samples_key,
                      [&r](double v) { r.reference_samples = static_cast<int>(v); });
    add_number_option(*command, "--rays", "Camera rays that are compared one by one; default 262144", rays_key,
                      [&r](double v) { r.experiment.rays = static_cast<std::size_t>(v); });
    command->add_option("--json", r.json, "Write everything as JSON")->type_name("FILE");
    command->add_option("--html", r.html, "Write tables and plot as a page that needs no other file")->type_name("FILE");
    command->add_option("--plot", r.plots, "Write the plot of error against time: SVG, or PNG by its ending")
        ->delimiter(',')
        ->type_name("LIST");
    add_frame_options(*command, r.frame);
    add_flatten_options(*command, r.frame);
    command->final_callback([&chosen, request] { chosen = [request] { return measure(*request); }; });
}

} // namespace lanecast
