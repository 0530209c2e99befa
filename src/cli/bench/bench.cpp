// lanecast bench: rays per second, beside Embree where it was found.

#include "cli/bench/builds.hpp"
#include "cli/bench/calls.hpp"
#include "cli/bench/features.hpp"
#include "cli/bench/frames.hpp"
#include "cli/bench/report.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/parse_value.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "render/output_file.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

using namespace bench;

struct BenchRequest {
    std::string mesh;
    std::string frames, features;        ///< a scene; instead of a mesh
    std::array<int, 2> size{1920, 1080}; ///< of its frames
    std::vector<double> camera;          ///< position, look_at, and perhaps the field
    std::vector<double> light;
    bool z_up = false;
    bool no_ground = false;
    bool no_peer = false;
    bool calls = false;
    bool builds = false;
    std::vector<std::size_t> triangles; ///< of terrain
    std::vector<std::string> kinds, isas, precisions, trees{"default"};
    std::vector<int> threads{1};
    std::size_t rays = 262144;
    std::size_t check = 65536;
    int repetitions = 7;
    std::vector<std::string> plots;
    std::string json, commit = "unknown";
    std::string options; ///< as given
};

BenchMesh prepare_mesh(const BenchRequest& request, std::size_t triangles) {
    BenchMesh mesh = make_mesh(request.mesh, triangles);
    if (!request.camera.empty()) {
        const auto& c = request.camera;
        view_from(mesh, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c.size() > 6 ? c[6] : 60,
                  request.z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
    } else if (mesh.name != "hall") {
        view_from_outside(mesh, !request.no_ground);
    }
    if (!request.light.empty()) mesh.view.light = {request.light[0], request.light[1], request.light[2]};
    return mesh;
}

std::vector<std::string> all_isas() {
    std::vector<std::string> names;
    for (const IsaInfo& isa : known_isas())
        if (isa.compiled && isa.supported && isa.name != "scalar") names.push_back(isa.name);
    return names.empty() ? std::vector<std::string>{"scalar"} : names;
}

/// Adds the rows of a set. Agreement is checked once, not for every number of threads.
void measure_set(const Contenders& contenders, const RaySet& set, int threads, const Truth* truth, const BenchRequest& request,
                 Report& report) {
    const Measured measured = measure(contenders, set, request.repetitions, threads);
    const std::size_t first = report.rows.size();
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        const Contender& contender = *contenders[c];
        Row row{set.name,
                contender.library,
                contender.isa,
                contender.precision,
                contender.mode,
                contender.ours,
                threads,
                set.size(),
                measured.rates[c],
                {},
                {}};
        if (truth != nullptr) row.reference = compare_to_truth(measured.hits[c], *truth);
        report.rows.push_back(row);
    }
    for (std::size_t c = 0; truth != nullptr && c < contenders.size(); ++c) {
        Row& row = report.rows[first + c];
        const Row* const peer = row.ours ? best_peer(report, row) : nullptr;
        if (peer == nullptr) continue;
        const auto place = static_cast<std::size_t>(peer - &report.rows[first]);
        row.peer = compare_to_peer(measured.hits[c], measured.hits[place], *truth);
    }
}

/// A line per size, tree, instruction set and number of threads.
void measure_builds(const BenchRequest& request, const std::vector<std::string>& isas) {
    for (const std::string& isa : isas) static_cast<void>(find_kernels(isa, Precision::balanced)); // refuses what is not there
    bool header = true;
    for (const std::size_t triangles : request.triangles.empty() ? std::vector{usual_terrain} : request.triangles) {
        const BenchMesh mesh = make_mesh(request.mesh, triangles);
        for (const std::string& tree : request.trees)
            for (const std::string& isa : isas)
                for (const int threads : request.threads) {
                    BuildsRequest builds;
                    builds.threads = threads;
                    builds.repetitions = request.repetitions;
                    builds.high = tree == "quality";
                    builds.with_peer = !request.no_peer;
                    print_result(measure_builds(mesh, isa, builds, header));
                    header = false;
                }
    }
}

/// What frames of a scene are asked for, whatever is then measured.
template <class FrameRequest>
FrameRequest scene_frames(const BenchRequest& request, const std::string& scene) {
    FrameRequest frames;
    frames.scene = scene;
    if (!request.isas.empty()) frames.isa = request.isas.front();
    if (!request.precisions.empty()) frames.precision = request.precisions.front();
    frames.width = request.size[0], frames.height = request.size[1];
    frames.pairs = request.repetitions;
    return frames;
}

int run_features(const BenchRequest& request) {
    FeaturesReport report = measure_features(scene_frames<FeaturesRequest>(request, request.features));
    report.commit = request.commit;
    if (!request.json.empty()) write_file(request.json, json_report(report));
    print_result(text_report(report));
    const bool same = std::ranges::all_of(report.rows, [](const FeatureRow& row) { return row.differing_pixels == 0; });
    return static_cast<int>(same ? ExitCode::done : ExitCode::failure);
}

int run(const BenchRequest& request) {
    if (!request.features.empty()) return run_features(request);
    if (!request.frames.empty()) {
        print_result(measure_frames(scene_frames<FramesRequest>(request, request.frames)));
        return static_cast<int>(ExitCode::done);
    }
    if (request.mesh.empty()) throw Error(ExitCode::usage, "bench: needs a mesh, or --frames or --features and a scene");
    const std::vector<std::string> isas = request.isas.empty() ? all_isas() : request.isas;
    if (request.builds) {
        measure_builds(request, isas);
        return static_cast<int>(ExitCode::done);
    }
    const std::vector<std::string> precisions =
        request.precisions.empty() ? std::vector<std::string>{"balanced"} : request.precisions;
    const BenchMesh mesh = prepare_mesh(request, request.triangles.empty() ? usual_terrain : request.triangles.front());
    const int threads = *std::max_element(request.threads.begin(), request.threads.end());
    if (request.calls) {
        for (const std::string& isa : isas) print_result(measure_calls(mesh, isa, request.repetitions));
        return static_cast<int>(ExitCode::done);
    }
    Report report{.mesh = mesh.name,
                  .cpu = cpu_name(),
                  .compiler = compiler_name(),
                  .commit = request.commit,
                  .options = request.options,
                  .triangles = mesh.triangles(),
                  .repetitions = request.repetitions,
                  .builds = {},
                  .rows = {}};
    Contenders contenders;
    for (const std::string& isa : isas) {
        for (const std::string& precision : precisions) {
            if (request.isas.empty() && precision == "fast" && isa == "sse4.2") continue; // has none
            for (const std::string& tree : request.trees)
                add_ours(contenders, report.builds, mesh, isa, precision, tree, threads);
        }
        if (!request.no_peer) add_embree(contenders, report.builds, mesh, isa, threads);
    }
    const Scene scene(mesh.arrays(), {.threads = threads});
    const std::vector<RaySet> sets =
        make_ray_sets(mesh, scene, request.kinds.empty() ? ray_kinds() : request.kinds, request.rays);
    const Scene reference(mesh.arrays(), {.threads = threads, .isa = "auto", .precision = "reference"});
    for (const int count : request.threads)
        for (const RaySet& set : sets) {
            const bool check = request.check > 0 && count == request.threads.front();
            const Truth truth = check ? find_truth(set, reference, mesh, request.check) : Truth{};
            measure_set(contenders, set, count, check ? &truth : nullptr, request, report);
        }
    if (!request.json.empty()) write_file(request.json, json_report(report));
    for (const std::string& file : request.plots) write_drawing(file, plot(report));
    print_result(text_report(report));
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_bench(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("bench", "Measure rays per second, beside Embree where it was found");
    const auto request = std::make_shared<BenchRequest>();
    command->add_option("mesh", request->mesh, "flake, terrain, hall, or an OBJ or PLY file")->type_name("MESH");
    command->add_option("--camera", request->camera, "x y z of the position, of the point looked at, and the field in degrees")
        ->expected(6, 7)
        ->type_name("NUMBERS");
    command->add_option("--light", request->light, "x y z of the point light")->expected(3)->type_name("NUMBERS");
    command->add_flag("--z-up", request->z_up, "With --camera: z is up, not y");
    command->add_flag("--no-ground", request->no_ground, "No square under a mesh seen from outside");
    command->add_flag("--no-peer", request->no_peer, "Without Embree");
    command->add_flag("--calls", request->calls, "What a call costs, in streams of 1 to 65536 rays, instead");
    command->add_flag("--builds", request->builds, "Building the tree, in turn with Embree, instead");
    command->add_option("--triangles", request->triangles, "Of terrain, about; several with --builds; default: 1048352")
        ->delimiter(',')
        ->check(CLI::Range(std::size_t{2}, std::size_t{1} << 25))
        ->type_name("LIST");
    command->add_option("--kinds", request->kinds, "Rays: primary, aa, shadow, light, sun, mirror, diffuse; default: all")
        ->delimiter(',')
        ->check(CLI::IsMember(ray_kinds()))
        ->type_name("LIST");
    command->add_option("--isa", request->isas, "Instruction sets; default: all but scalar")->delimiter(',')->type_name("LIST");
    command->add_option("--precision", request->precisions, "Precisions; default: balanced")->delimiter(',')->type_name("LIST");
    command->add_option("--bvh", request->trees, "Trees: default, quality; default: default")->delimiter(',')->type_name("LIST");
    command->add_option("--threads", request->threads, "Numbers of threads; default: 1")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024))
        ->type_name("LIST");
    command->add_option("--rays", request->rays, "Rays of each kind, about")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 24))
        ->type_name("N");
    command->add_option("--repetitions", request->repetitions, "Of which the median counts")
        ->check(CLI::Range(1, 10000))
        ->type_name("N");
    CLI::Option* const frames =
        command->add_option("--frames", request->frames, "Whole frames of a scene instead, one thread and two in turn")
            ->type_name("FILE");
    command
        ->add_option("--features", request->features, "What each feature costs that a scene leaves out, in whole frames, instead")
        ->type_name("FILE")
        ->excludes(frames);
    command
        ->add_option_function<std::string>(
            "--size", [request](const std::string& text) { request->size = parse_size("--size", text); },
            "Of these frames; default 1920x1080")
        ->type_name("WxH");
    command->add_option("--commit", request->commit, "For the record")->type_name("TEXT");
    command->add_option("--check", request->check, "Rays of each kind whose hits are compared")->type_name("N");
    command->add_option("--json", request->json, "Write everything as JSON")->type_name("FILE");
    command->add_option("--plot", request->plots, "Write a plot: SVG, or PNG by its ending")->delimiter(',')->type_name("LIST");
    command->final_callback([&chosen, request, command] {
        request->options = command->config_to_str();
        std::replace(request->options.begin(), request->options.end(), '\n', ' ');
        chosen = [request] { return run(*request); };
    });
}

} // namespace lanecast
