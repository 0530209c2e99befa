#include "cli/selftest/run.hpp"

#include "cli/selftest/random.hpp"
#include "scene/parallel.hpp"

#include <algorithm>
#include <chrono>

namespace lanecast::selftest {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::uint64_t seed_of(const Case& c, std::uint64_t block) {
    std::uint64_t seed = 0x6c616e6563617374u; // "lanecast"
    for (const char letter : name_of(c)) seed = mix(seed ^ static_cast<unsigned char>(letter));
    return mix(seed + block * 0x9e3779b97f4a7c15u);
}

} // namespace

void run_case(const Plan& plan, const std::vector<const KernelTable*>& kernels, int threads, const std::atomic<bool>& stop,
              Progress& progress, const std::function<void()>& saved) {
    const auto begin = Clock::now();
    const double before = progress.seconds;
    auto last_saved = begin;
    const Team team(threads);
    const std::size_t wave = static_cast<std::size_t>(threads) * 8; // a few seconds at most
    while (progress.blocks < plan.blocks) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(wave, plan.blocks - progress.blocks));
        std::vector<Tally> tallies(count);
        parallel_for(threads, count, [&](std::size_t i) {
            if (stop.load(std::memory_order_relaxed)) return;
            const std::uint64_t number = progress.blocks + i;
            const Setting& setting = plan.settings[number % plan.settings.size()];
            const Block block{setting, seed_of(*progress.c, number), block_rays(setting, plan.usual_rays), kernels};
            progress.c->run(block, tallies[i]);
            if (tallies[i].failures > 0)
                tallies[i].example = "block " + std::to_string(number) + " (" + text_of(setting) + "): " + tallies[i].example;
        });
        if (stop.load()) break;
        for (const Tally& tally : tallies) progress.tally.add(tally); // in their order, whoever ran them
        progress.blocks += count;
        progress.seconds = before + seconds_since(begin);
        if (seconds_since(last_saved) > 5) {
            saved();
            last_saved = Clock::now();
        }
    }
    saved();
}

} // namespace lanecast::selftest
