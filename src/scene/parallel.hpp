#pragma once
// Loops over independent pieces of work, and the threads that share them.

#include <cstddef>
#include <functional>
#include <memory>

namespace lanecast {

/// Calls body(0) .. body(count - 1), each once, on up to `threads` threads, the caller's included; returns when all are done.
/// The first exception is rethrown. Pieces should take microseconds or more: without a Team threads are started for each loop.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

/// Threads that wait for the loops of the thread which made the team, for as long as it lives. A loop does not wait for one that
/// has not come by when all is done: on a busy machine that took longer than the work. Measured: docs/performance.md.
class Team {
public:
    explicit Team(int threads);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

private:
    class Helpers;
    std::unique_ptr<Helpers> helpers_;
    friend void parallel_for(int, std::size_t, const std::function<void(std::size_t)>&);
};

/// Number of pieces of at most `piece` that cover `count`.
[[nodiscard]] constexpr std::size_t piece_count(std::size_t count, std::size_t piece) noexcept {
    return (count + piece - 1) / piece;
}

} // namespace lanecast
