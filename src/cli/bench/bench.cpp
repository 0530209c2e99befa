// lanecast bench: rays per second, beside Embree where it was found.

#include "cli/bench/report.hpp"
#include "cli/commands.hpp"
#include "cli/parse_value.hpp"
#include "cli/print.hpp"
#include "render/dispatch.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

using namespace bench;

struct BenchRequest {
    std::string mesh = "flake";
    std::vector<double> camera; ///< position, look_at, and perhaps the field
    std::vector<double> light;
    bool no_ground = false;
    bool no_peer = false;
    std::vector<std::string> kinds, isas, precisions{"balanced"};
    std::vector<int> threads{1};
    std::size_t rays = 262144;
    int repetitions = 7;
};

BenchMesh prepare_mesh(const BenchRequest& request) {
    BenchMesh mesh = make_mesh(request.mesh);
    if (!request.camera.empty()) {
        const auto& c = request.camera;
        view_from(mesh, {c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c.size() > 6 ? c[6] : 60);
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

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown CPU";
}

void measure_set(const Contenders& contenders, const RaySet& set, int threads, const BenchRequest& request, Report& report) {
    const Measured measured = measure(contenders, set, request.repetitions, threads);
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        const Contender& contender = *contenders[c];
        report.rows.push_back({set.name,
                               contender.library,
                               contender.isa,
                               contender.precision,
                               contender.mode,
                               contender.ours,
                               threads,
                               set.size(),
                               measured.rates[c],
                               {}});
    }
}

int run(const BenchRequest& request) {
    const BenchMesh mesh = prepare_mesh(request);
    const std::vector<std::string> isas = request.isas.empty() ? all_isas() : request.isas;
    const int threads = *std::max_element(request.threads.begin(), request.threads.end());
    Report report{.mesh = mesh.name,
                  .cpu = cpu_name(),
                  .compiler = LANECAST_COMPILER,
                  .commit = LANECAST_COMMIT,
                  .options = {},
                  .triangles = mesh.triangles(),
                  .repetitions = request.repetitions,
                  .builds = {},
                  .rows = {}};
    Contenders contenders;
    for (const std::string& isa : isas) {
        for (const std::string& precision : request.precisions)
            add_ours(contenders, report.builds, mesh, isa, precision, threads);
        if (!request.no_peer) add_embree(contenders, report.builds, mesh, isa, threads);
    }
    const Scene scene(mesh.arrays(), {.threads = threads});
    const std::vector<RaySet> sets =
        make_ray_sets(mesh, scene, request.kinds.empty() ? ray_kinds() : request.kinds, request.rays);
    for (const int count : request.threads)
        for (const RaySet& set : sets) measure_set(contenders, set, count, request, report);
    print_result(text_report(report));
    return static_cast<int>(ExitCode::done);
}

} // namespace

void add_bench(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("bench", "Measure rays per second, beside Embree where it was found");
    const auto request = std::make_shared<BenchRequest>();
    command->add_option("mesh", request->mesh, "flake, terrain, hall, or an OBJ or PLY file")->required()->type_name("MESH");
    command->add_option("--camera", request->camera, "x y z of the position, of the point looked at, and the field in degrees")
        ->expected(6, 7)
        ->type_name("NUMBERS");
    command->add_option("--light", request->light, "x y z of the point light")->expected(3)->type_name("NUMBERS");
    command->add_flag("--no-ground", request->no_ground, "No square under a mesh seen from outside");
    command->add_flag("--no-peer", request->no_peer, "Without Embree");
    command->add_option("--kinds", request->kinds, "Rays: primary, aa, shadow, light, sun, mirror, diffuse; default: all")
        ->delimiter(',')
        ->check(CLI::IsMember(ray_kinds()))
        ->type_name("LIST");
    command->add_option("--isa", request->isas, "Instruction sets; default: all but scalar")->delimiter(',')->type_name("LIST");
    command->add_option("--precision", request->precisions, "Precisions; default: balanced")->delimiter(',')->type_name("LIST");
    command->add_option("--threads", request->threads, "Numbers of threads; default: 1")->delimiter(',')->type_name("LIST");
    command->add_option("--rays", request->rays, "Rays of each kind, about")->type_name("N");
    command->add_option("--repetitions", request->repetitions, "Of which the median counts")->type_name("N");
    command->final_callback([&chosen, request] { chosen = [request] { return run(*request); }; });
}

} // namespace lanecast
