#include "cli/bench/measure.hpp"

#include "cli/bench/quantile.hpp"

#include <chrono>
#include <thread>

namespace lanecast::bench {
namespace {

/// As Embree asks its callers to have it, and as our own calls do it themselves: denormals are zero.
void flush_denormals() { __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040u); }

void time_chunks(Contender& contender, std::size_t begin, std::size_t end, std::uint64_t* ticks) {
    flush_denormals();
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
        contender.reset(chunk);
        const std::uint64_t start = __builtin_ia32_rdtsc();
        contender.trace(chunk);
        ticks[chunk] = __builtin_ia32_rdtsc() - start;
    }
}

/// Chunks where the share of a thread begins.
std::vector<std::size_t> shares(std::size_t chunks, int threads) {
    std::vector<std::size_t> first;
    for (int i = 0; i <= threads; ++i) first.push_back(chunks * static_cast<std::size_t>(i) / static_cast<std::size_t>(threads));
    return first;
}

void time_all(Contender& contender, const std::vector<std::size_t>& first, std::uint64_t* ticks) {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i + 1 < first.size(); ++i)
        threads.emplace_back([&, i] { time_chunks(contender, first[i], first[i + 1], ticks); });
    time_chunks(contender, first[0], first[1], ticks);
}

/// ticks[repetition][chunk]
Rate rate_of(const RaySet& set, const std::vector<std::vector<std::uint64_t>>& ticks, const std::vector<std::size_t>& first,
             double frequency) {
    Rate rate;
    std::vector<double> whole(ticks.size());
    for (std::size_t share = 0; share + 1 < first.size(); ++share) {
        double rays = 0, sum = 0;
        std::vector<double> sums(ticks.size());
        for (std::size_t chunk = first[share]; chunk < first[share + 1]; ++chunk) {
            std::vector<std::uint64_t> times;
            for (std::size_t r = 0; r < ticks.size(); ++r) {
                times.push_back(ticks[r][chunk]);
                sums[r] += static_cast<double>(ticks[r][chunk]);
            }
            rays += static_cast<double>(set.chunk_size(chunk));
            sum += static_cast<double>(quantile(times, 0.5));
        }
        if (sum == 0) continue;
        rate.rays_per_second += rays / sum * frequency;
        for (std::size_t r = 0; r < ticks.size(); ++r) whole[r] += rays / sums[r] * frequency;
    }
    rate.low = quantile(whole, 0.25);
    rate.high = quantile(whole, 0.75);
    return rate;
}

} // namespace

double ticks_per_second() {
    static const double frequency = [] {
        using Clock = std::chrono::steady_clock;
        const auto begin = Clock::now();
        const std::uint64_t first = __builtin_ia32_rdtsc();
        while (Clock::now() - begin < std::chrono::milliseconds(50)) {
        }
        const auto ticks = static_cast<double>(__builtin_ia32_rdtsc() - first);
        return ticks / std::chrono::duration<double>(Clock::now() - begin).count();
    }();
    return frequency;
}

Measured measure(const Contenders& contenders, const RaySet& set, int repetitions, int threads) {
    const double frequency = ticks_per_second();
    const std::vector<std::size_t> first = shares(set.chunks(), threads);
    std::vector<std::vector<std::vector<std::uint64_t>>> ticks(contenders.size());
    Measured measured;
    for (const auto& contender : contenders) {
        std::vector<std::uint64_t> unused(set.chunks());
        contender->prepare(set);
        time_all(*contender, first, unused.data());
        measured.hits.push_back(contender->hits());
    }
    for (int r = 0; r < repetitions; ++r)
        for (std::size_t c = 0; c < contenders.size(); ++c)
            time_all(*contenders[c], first, ticks[c].emplace_back(set.chunks()).data());
    for (const auto& own : ticks) measured.rates.push_back(rate_of(set, own, first, frequency));
    return measured;
}

} // namespace lanecast::bench
