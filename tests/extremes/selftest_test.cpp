// What `lanecast selftest` promises beside its cases: every pair of values is met, and neither threads nor a break change a
// result.

#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/peer.hpp"
#include "cli/selftest/report.hpp"
#include "cli/selftest/run.hpp"
#include "cli/selftest/scenes.hpp"
#include "cli/selftest/state.hpp"
#include "render/dispatch.hpp"
#include "scene/error.hpp"
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

using namespace lanecast;
using namespace lanecast::selftest;

namespace {

std::vector<const KernelTable*> some_kernels() {
    return {&find_kernels("scalar", Precision::reference), &find_kernels("scalar", Precision::balanced),
            &find_kernels("auto", Precision::balanced)};
}

const Case& case_named(const std::string& name) {
    for (const Case& c : all_cases())
        if (selftest::name_of(c) == name) return c;
    throw std::runtime_error("no case " + name);
}

Progress start(const Case& c, const Plan& plan) {
    Progress progress;
    progress.c = &c;
    progress.planned = plan.blocks;
    return progress;
}

void check_equal(const Tally& a, const Tally& b) {
    CHECK(a.rays == b.rays);
    CHECK(a.failures == b.failures);
    CHECK(a.worst == b.worst);
    CHECK(a.errors == b.errors);
    CHECK(a.example == b.example);
}

const std::atomic<bool> never{false};

/// Fails and errs by its seed.
void noisy(const Block& block, Tally& tally) {
    Random random(block.seed);
    tally.rays += block.rays;
    tally.add_error(random.magnitude(1e-3, 1e3));
    if (random.chance(0.2)) tally.fail("with seed " + std::to_string(block.seed));
}
const Case noisy_case{"N0", "noise", "", {}, noisy, {every_primitive, every_placing, every_path, true}, 1000, 100};

struct TemporaryFile {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("lanecast-selftest-" + std::to_string(::getpid()) + ".state");
    ~TemporaryFile() { std::filesystem::remove(path); }
};

} // namespace

TEST_CASE("every pair of values of two factors stands in a row of the covering list") {
    const auto kernels = some_kernels();
    const std::vector<Setting> rows = covering_settings(noisy_case, kernels);
    CHECK(rows.size() < 120);
    const auto values = [](const Setting& s) {
        return std::array<std::string, 5>{std::string(s.kernels->isa) + name_of(s.kernels->precision),
                                          std::to_string(static_cast<int>(s.primitive)), selftest::name_of(s.placing),
                                          std::to_string(s.leaf_size), selftest::name_of(s.path)};
    };
    std::array<std::set<std::string>, 5> all;
    std::set<std::string> met;
    for (const Setting& row : rows) {
        const auto v = values(row);
        for (std::size_t i = 0; i < 5; ++i) all[i].insert(v[i]);
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t k = i + 1; k < 5; ++k) met.insert(std::to_string(i) + v[i] + "|" + std::to_string(k) + v[k]);
    }
    CHECK(all[0].size() == kernels.size());
    CHECK(all[1].size() == 7);
    CHECK(all[2].size() == 6);
    CHECK(all[3].size() == 8);
    CHECK(all[4].size() == 3);
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t k = i + 1; k < 5; ++k)
            for (const std::string& a : all[i])
                for (const std::string& b : all[k]) CHECK(met.count(std::to_string(i) + a + "|" + std::to_string(k) + b) == 1);
}

TEST_CASE("a plan sends about as many rays as are asked for, and runs each row") {
    const auto kernels = some_kernels();
    for (const double wanted : {1e3, 1e5, 1e7, 1e9}) {
        const Plan plan = make_plan(case_named("N3 near"), kernels, static_cast<std::uint64_t>(wanted));
        CHECK(plan.blocks % plan.settings.size() == 0);
        double rays = 0;
        for (const Setting& s : plan.settings)
            rays += static_cast<double>(block_rays(s, plan.usual_rays)) *
                    (static_cast<double>(plan.blocks) / static_cast<double>(plan.settings.size()));
        CHECK(rays >= std::min(wanted, rays));
        if (wanted >= 1e5) CHECK(rays < 2.5 * wanted);
        if (wanted >= 1e7) CHECK(rays >= wanted);
    }
}

TEST_CASE("results depend neither on threads nor on where a run was broken off") {
    const auto kernels = some_kernels();
    for (const Case* c : std::initializer_list<const Case*>{&noisy_case, &case_named("N12 needles")}) {
        const Plan plan = make_plan(*c, kernels, 300'000);
        Progress whole = start(*c, plan), single = start(*c, plan);
        run_case(plan, kernels, 3, never, whole, [] {});
        run_case(plan, kernels, 1, never, single, [] {});
        check_equal(whole.tally, single.tally);
        CHECK(whole.tally.rays > 0);

        const TemporaryFile file;
        std::vector<Progress> state{start(*c, plan)};
        Plan half = plan;
        half.blocks = plan.blocks / 2;
        run_case(half, kernels, 2, never, state[0], [] {});
        write_state(file.path, "a run", state);
        std::vector<Progress> resumed{start(*c, plan)};
        read_state(file.path, "a run", resumed);
        CHECK(resumed[0].blocks == half.blocks);
        run_case(plan, kernels, 2, never, resumed[0], [] {});
        check_equal(whole.tally, resumed[0].tally);
        CHECK(resumed[0].is_done());
    }
}

TEST_CASE("a run that is stopped counts no block that was under way") {
    const auto kernels = some_kernels();
    static std::atomic<bool> stop;
    static std::atomic<int> calls;
    stop = false, calls = 0;
    const Case stopping{"N0",
                        "stop",
                        "",
                        {},
                        [](const Block& block, Tally& tally) {
                            if (++calls == 30) stop = true;
                            noisy(block, tally);
                        },
                        noisy_case.scope,
                        1000,
                        100};
    const Plan plan = make_plan(stopping, kernels, 100'000);
    Progress broken = start(stopping, plan);
    int saved = 0;
    run_case(plan, kernels, 2, stop, broken, [&] { ++saved; });
    CHECK(saved > 0);
    CHECK(broken.blocks < plan.blocks);
    CHECK(broken.blocks > 0);
    Plan part = plan;
    part.blocks = broken.blocks;
    stop = false, calls = 1000;
    Progress again = start(stopping, part);
    run_case(part, kernels, 1, never, again, [] {});
    check_equal(broken.tally, again.tally);
}

TEST_CASE("the state of another run, and what is no state, are refused") {
    const TemporaryFile file;
    const Plan plan = make_plan(noisy_case, some_kernels(), 1000);
    std::vector<Progress> state{start(noisy_case, plan)};
    read_state(file.path, "a run", state); // none there
    CHECK(state[0].blocks == 0);
    state[0].blocks = 1;
    write_state(file.path, "a run", state);
    CHECK_THROWS_AS(read_state(file.path, "another", state), Error);
    std::ofstream(file.path) << "{}\n";
    CHECK_THROWS_AS(read_state(file.path, "a run", state), Error);
}

TEST_CASE("percentiles and targets") {
    Tally tally;
    for (int i = 1; i <= 1000; ++i) tally.add_error(i);
    tally.rays = 1000;
    CHECK(tally.worst == 1000);
    CHECK(tally.percentile(0.5) >= 500);
    CHECK(tally.percentile(0.5) <= 523);
    CHECK(tally.mean() == doctest::Approx(500).epsilon(0.05));
    CHECK(is_met({.worst = 1000}, tally));
    CHECK(!is_met({.worst = 999}, tally));
    CHECK(!is_met({.p99 = 900}, tally));
    CHECK(!is_met({.mean = 400}, tally));
    CHECK(!is_met({.median = 400}, tally));
    tally.fail("x");
    CHECK(!is_met({}, tally));
    CHECK(is_met({.failure_rate = 1e-3}, tally));
    Tally bad;
    bad.add_error(std::numeric_limits<double>::quiet_NaN());
    CHECK(!is_met({.worst = 1e300}, bad));
}

TEST_CASE("a tree with leaves of a given size has them, and every primitive once") {
    Random random(1);
    for (int size = 1; size <= 8; ++size)
        for (int kind = 0; kind < 7; ++kind) {
            const SceneDescription description = random_scene(static_cast<PrimitiveKind>(kind), Placing::plain, 40, random);
            const SceneArrays usual = flatten(description, RenderSettings{}, 1), arrays = with_leaves_of(usual, size);
            std::vector<int> seen(arrays.first_slot[6]);
            int smaller = 0;
            for (const std::uint64_t leaf : arrays.leaves) {
                const auto count = static_cast<std::uint32_t>(leaf >> child_count_shift & child_count_mask) + 1;
                for (std::uint32_t i = 0; i < count; ++i) ++seen[static_cast<std::uint32_t>(leaf) + i];
                CHECK(count <= static_cast<std::uint32_t>(size));
                smaller += count < static_cast<std::uint32_t>(size) ? 1 : 0;
            }
            for (const int n : seen) CHECK(n == 1);
            CHECK(smaller <= 6); // the last of each kind
            const Rays rays = random_rays(usual, 2000, 100, random);
            const KernelTable& kernels = find_kernels("auto", Precision::balanced);
            const Hits a = ask(kernels, view(usual), rays, Path::batch), b = ask(kernels, view(arrays), rays, Path::batch);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                CHECK(bits_of(a.t[i]) == bits_of(b.t[i]));
                if (a.slot[i] >= 0 && b.slot[i] >= 0)
                    CHECK(usual.scene_id[static_cast<std::size_t>(a.slot[i])] ==
                          arrays.scene_id[static_cast<std::size_t>(b.slot[i])]);
            }
        }
}

TEST_CASE("what peers are asked: known cases over what they have, in streams; ours holds those about streams alone") {
    const std::vector<const KernelTable*> kernels{&find_kernels("auto", Precision::balanced)};
    std::set<std::string> names;
    for (const Case& c : peer_cases()) {
        CHECK(names.insert(selftest::name_of(c)).second);
        CHECK(c.scope.primitives != 0);
        CHECK((c.scope.primitives & (only(PrimitiveKind::open_cone) | only(PrimitiveKind::plane))) == 0);
        CHECK((c.scope.paths & only(Path::single)) == 0);
        CHECK(!c.scope.leaf_sizes);
    }
    CHECK(names.size() == 22); // a name that all_cases() does not know would be missing
    for (const char* const name : {"N3 streams", "N5 streams, to 2^20", "N5 streams, to 2^36"}) {
        const auto& cases = peer_cases();
        const auto c = std::find_if(cases.begin(), cases.end(), [&](const Case& x) { return selftest::name_of(x) == name; });
        REQUIRE(c != cases.end());
        const Plan plan = make_plan(*c, kernels, 50'000);
        Progress progress = start(*c, plan);
        run_case(plan, kernels, 2, never, progress, [] {});
        CHECK(progress.tally.rays > 10'000);
        CHECK(progress.tally.failures == 0);
    }
}
