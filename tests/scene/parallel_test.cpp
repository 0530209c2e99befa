// Loops over pieces of work: each piece once, errors reach the caller, with a team of waiting threads and without.

#include "scene/parallel.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

void check_loops(int threads) {
    for (const std::size_t count : {0, 1, 2, 3, 17, 1000})
        for (int turn = 0; turn < 20; ++turn) {
            std::vector<std::atomic<int>> times(count);
            parallel_for(threads, count, [&](std::size_t i) { ++times[i]; });
            for (const auto& n : times) REQUIRE(n == 1);
        }
    for (int turn = 0; turn < 20; ++turn) {
        CHECK_THROWS_AS(parallel_for(threads, 100,
                                     [](std::size_t i) {
                                         if (i == 40) throw std::runtime_error("40");
                                     }),
                        std::runtime_error);
        std::atomic<int> after = 0; // a team is as good as new
        parallel_for(threads, 100, [&](std::size_t) { ++after; });
        REQUIRE(after == 100);
    }
}

} // namespace

TEST_CASE("each piece once, the first error rethrown") {
    for (const int threads : {-1, 0, 1, 2, 5}) {
        check_loops(threads);
        const Team team(threads);
        check_loops(threads);
    }
}

TEST_CASE("the threads of a team are the same in every loop, and take part") {
    const Team team(3);
    std::set<std::thread::id> seen;
    std::mutex mutex;
    for (int turn = 0; turn < 50 || (turn < 5000 && seen.size() < 3); ++turn) // on a busy machine they come late
        parallel_for(3, 30, [&](std::size_t) {
            {
                const std::lock_guard lock(mutex);
                seen.insert(std::this_thread::get_id());
            }
            std::this_thread::sleep_for(std::chrono::microseconds(100)); // so that helpers have the time to come
        });
    CHECK(seen.size() == 3);
}

TEST_CASE("a loop within a piece, a team within a team, and teams of several callers") {
    const auto nested = [] {
        const Team team(3);
        const Team inner(2);
        std::atomic<int> sum = 0;
        for (int turn = 0; turn < 20; ++turn)
            parallel_for(3, 8, [&](std::size_t) {
                const Team own(2);
                parallel_for(2, 8, [&](std::size_t) { ++sum; });
            });
        return sum.load();
    };
    CHECK(nested() == 20 * 64);
    std::atomic<int> right = 0;
    {
        std::vector<std::jthread> callers;
        for (int i = 0; i < 4; ++i)
            callers.emplace_back([&] {
                if (nested() == 20 * 64) ++right;
            });
    }
    CHECK(right == 4);
}
