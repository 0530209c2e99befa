// lanecast selftest: the invariants of docs/extremes.md, tried on this machine by as many rays as one likes.

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/print.hpp"
#include "cli/selftest/peer_report.hpp"
#include "cli/selftest/report.hpp"
#include "cli/selftest/run.hpp"
#include "cli/selftest/state.hpp"
#include "render/dispatch.hpp"
#include "render/output_file.hpp"
#include "scene/error.hpp"
#include "scene/thread_count.hpp"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

using namespace selftest;

constexpr double full_rays = 1e9;

struct SelftestRequest {
    bool full = false;
    double rays = 0; ///< per id; 0: as the size says
    std::vector<std::string> only, isas, precisions;
    std::string json, resume, peer;
    int threads = 0;
    bool list = false;
};

/// Those of this build that this CPU runs, the slowest first.
std::vector<const KernelTable*> chosen_kernels(const SelftestRequest& request) {
    std::vector<const KernelTable*> tables;
    const auto wanted = [](const std::vector<std::string>& names, std::string_view name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const std::string& name : request.precisions) static_cast<void>(precision_named(name));
    for (const KernelTable* table : usable_kernels())
        if (wanted(request.isas, table->isa) && wanted(request.precisions, lanecast::name_of(table->precision)))
            tables.push_back(table);
    if (tables.empty()) throw Error(ExitCode::usage, "selftest: there are no kernels of that instruction set and precision");
    return tables;
}

const std::vector<Case>& known_cases(const SelftestRequest& request) { return request.peer.empty() ? all_cases() : peer_cases(); }

std::vector<const Case*> chosen_cases(const SelftestRequest& request) {
    std::vector<const Case*> cases;
    for (const Case& c : known_cases(request))
        if (request.only.empty() || std::find(request.only.begin(), request.only.end(), c.id) != request.only.end())
            cases.push_back(&c);
    for (const std::string& id : request.only)
        if (std::none_of(cases.begin(), cases.end(), [&](const Case* c) { return id == c->id; }))
            throw Error(ExitCode::usage, "--only: there is no case '" + id + "'; `lanecast selftest --list` names them");
    return cases;
}

std::uint64_t rays_of(const SelftestRequest& request, const Case& c) {
    const std::vector<Case>& known = known_cases(request);
    const auto parts =
        std::count_if(known.begin(), known.end(), [&](const Case& other) { return std::string_view(other.id) == c.id; });
    if (request.rays == 0 && !request.full) return c.quick_rays;
    const double rays = request.rays > 0 ? request.rays : full_rays;
    return static_cast<std::uint64_t>(rays * c.full_share / static_cast<double>(parts));
}

std::string list_of_cases(const std::vector<Case>& cases) {
    std::string text;
    for (const Case& c : cases) {
        std::string name = selftest::name_of(c);
        name.resize(std::max<std::size_t>(name.size() + 1, 18), ' ');
        text += name + c.statement + " (" + text_of(c.target) + ")\n";
    }
    return text;
}

/// What a state must agree in.
std::string describe(const SelftestRequest& request, const std::vector<const KernelTable*>& kernels) {
    std::string text = std::string("lanecast ") + LANECAST_VERSION + ", ";
    if (request.rays > 0)
        text += short_count(request.rays) + " rays per case";
    else
        text += request.full ? "full" : "quick";
    for (const KernelTable* k : kernels) text += std::string(", ") + k->isa + " " + lanecast::name_of(k->precision);
    return text;
}

Progress start(const Case& c, const Plan& plan) {
    Progress progress;
    progress.c = &c;
    progress.planned = plan.blocks;
    return progress;
}

/// Ours on one instruction set and the peer on the same one, each asked the same rays.
int run_beside_peer(SelftestRequest request) {
    if (!request.resume.empty()) throw Error(ExitCode::usage, "--resume: a comparison with a peer is not kept");
    if (request.isas.empty()) request.isas = {std::string(best_isa())};
    if (request.isas.size() > 1) throw Error(ExitCode::usage, "--isa: one at a time with --peer");
    const std::vector<const KernelTable*> ours = chosen_kernels(request);
    std::vector<Contender> contenders;
    for (const KernelTable* k : ours) contenders.push_back({std::string("Lanecast ") + lanecast::name_of(k->precision), k});
    for (const Contender& peer : embree_contenders(request.isas.front())) contenders.push_back(peer);
    const std::string what = describe(request, ours) + ", beside " + contenders.back().name;
    const int threads = request.threads > 0 ? request.threads : default_thread_count();
    const InterruptScope interrupt;
    print_result(what + "\n\n" + comparison_header(contenders));
    std::vector<std::vector<Progress>> rows;
    for (const Case* c : chosen_cases(request)) {
        std::vector<Progress> row;
        for (const Contender& contender : contenders) {
            const std::vector<const KernelTable*> alone{contender.kernels}; // so blocks are the same for each
            const Plan plan = make_plan(*c, alone, rays_of(request, *c));
            row.push_back(start(*c, plan));
            run_case(plan, alone, threads, interrupt.stop(), row.back(), [] {});
            interrupt.check();
        }
        print_result(comparison_row(row));
        rows.push_back(row);
    }
    if (!request.json.empty()) write_file(request.json, comparison_json(what, contenders, rows));
    return static_cast<int>(ExitCode::done);
}

int run(SelftestRequest request) {
    if (request.list) {
        print_result(list_of_cases(known_cases(request)));
        return static_cast<int>(ExitCode::done);
    }
    for (std::string& isa : request.isas)
        isa = find_kernels(isa, Precision::balanced).isa; // "auto", and names that are not known
    if (!request.peer.empty()) return run_beside_peer(request);
    const std::vector<const KernelTable*> kernels = chosen_kernels(request);
    const std::string what = describe(request, kernels);
    const int threads = request.threads > 0 ? request.threads : default_thread_count();
    std::vector<Plan> plans;
    std::vector<Progress> all;
    for (const Case* c : chosen_cases(request)) {
        plans.push_back(make_plan(*c, kernels, rays_of(request, *c)));
        all.push_back(start(*c, plans.back()));
    }
    if (!request.resume.empty()) read_state(request.resume, what, all);
    const auto save = [&] {
        if (!request.resume.empty()) write_state(request.resume, what, all);
    };
    const InterruptScope interrupt;
    print_result(what + "\n\n" + table_header());
    if (!request.resume.empty()) print_message("selftest: started; its state is kept in " + request.resume);
    bool met = true;
    for (std::size_t i = 0; i < all.size(); ++i) {
        run_case(plans[i], kernels, threads, interrupt.stop(), all[i], save);
        print_result(table_row(all[i]));
        if (interrupt.stop().load()) break;
        met = met && (all[i].c->target.listed || is_met(all[i].c->target, all[i].tally));
    }
    if (!request.json.empty()) write_file(request.json, json_report(what, all));
    try {
        interrupt.check();
    } catch (const Interrupted& interrupted) {
        print_message("lanecast: interrupted" +
                      (request.resume.empty() ? "" : "; --resume " + request.resume + " goes on from here"));
        return 128 + interrupted.signal;
    }
    print_result(met ? "\nevery target is met\n" : "\nA TARGET IS MISSED\n");
    return static_cast<int>(met ? ExitCode::done : ExitCode::failure);
}

} // namespace

void add_selftest(CLI::App& app, Command& chosen) {
    CLI::App* const command =
        app.add_subcommand("selftest", "Try what must hold at the extremes, on the kernels of this machine");
    const auto request = std::make_shared<SelftestRequest>();
    command->add_flag("--full", request->full, "1e9 rays per case instead of a minute's worth: about two hours on two cores");
    command->add_option("--rays", request->rays, "Rays per case, about; scalar kernels get a 32nd of a share")
        ->check(CLI::Range(1.0, 1e15))
        ->type_name("N");
    command->add_option("--only", request->only, "Cases: N1 to N21, N23; default: all")->delimiter(',')->type_name("LIST");
    command->add_option("--isa", request->isas, "Instruction sets; default: all of this build and CPU")
        ->delimiter(',')
        ->type_name("LIST");
    command->add_option("--precision", request->precisions, "Precisions; default: all")->delimiter(',')->type_name("LIST");
    command->add_option("--threads", request->threads, "Default: all CPUs")->check(CLI::Range(1, 1024))->type_name("N");
    command->add_option("--json", request->json, "Write the results as JSON")->type_name("FILE");
    command->add_option("--resume", request->resume, "Keep the state in FILE, and go on from it if it is there")
        ->type_name("FILE");
    command->add_option("--peer", request->peer, "Ask a peer the same rays where a case makes sense for it: embree")
        ->check(CLI::IsMember({"embree"}))
        ->type_name("NAME");
    command->add_flag("--list", request->list, "Only name the cases, what they state and their targets");
    command->final_callback([&chosen, request] { chosen = [request] { return run(*request); }; });
}

} // namespace lanecast
