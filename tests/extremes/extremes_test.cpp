// The invariants at the extremes (numerics N1 to N23), as `lanecast selftest` runs them.

#include "cli/selftest/report.hpp"
#include "cli/selftest/run.hpp"
#include "render/dispatch.hpp"
#include "scene/thread_count.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace lanecast;
using namespace lanecast::selftest;

namespace {

#ifdef LANECAST_SANITIZED
constexpr std::uint64_t fewer = 100;
#else
constexpr std::uint64_t fewer = 1;
#endif

} // namespace

TEST_CASE("the invariants of docs/extremes.md hold") {
    const std::vector<const KernelTable*> kernels = usable_kernels();
    const std::atomic<bool> stop{false};
    for (const Case& c : all_cases()) {
        const Plan plan = make_plan(c, kernels, std::max<std::uint64_t>(c.quick_rays / fewer, 65536));
        Progress progress;
        progress.c = &c;
        progress.planned = plan.blocks;
        run_case(plan, kernels, default_thread_count(), stop, progress, [] {});
        MESSAGE(table_row(progress));
        // times are the machine's; they are for `lanecast selftest` to judge
        if (selftest::name_of(c) == "N15 time") continue;
        CHECK_MESSAGE((is_met(c.target, progress.tally) || c.target.listed), c.id, " ", c.part, ": ", c.statement);
        CHECK((progress.tally.rays > 0 || fewer > 1)); // a few blocks may all fall to kernels that have nothing to compare
    }
}
