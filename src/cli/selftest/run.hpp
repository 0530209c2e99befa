#pragma once
// Runs the blocks of a case on all threads.

#include "cli/selftest/plan.hpp"
#include "cli/selftest/progress.hpp"

#include <atomic>
#include <functional>

namespace lanecast::selftest {

/// From progress.blocks on, until `stop`; blocks that were under way then are not counted. The tally does not depend on
/// `threads`. `saved` is called every few seconds, from the calling thread, and at the end.
void run_case(const Plan& plan, const std::vector<const KernelTable*>& kernels, int threads, const std::atomic<bool>& stop,
              Progress& progress, const std::function<void()>& saved);

} // namespace lanecast::selftest
