#pragma once
// A loop over independent pieces of work on std::jthread.

#include <cstddef>
#include <functional>

namespace lanecast {

/// Calls body(0) .. body(count - 1), each once, on up to `threads` threads, the caller's included; returns when all are done.
/// The first exception is rethrown. Pieces should take microseconds or more: threads are started for each loop.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

/// Number of pieces of at most `piece` that cover `count`.
[[nodiscard]] constexpr std::size_t piece_count(std::size_t count, std::size_t piece) noexcept {
    return (count + piece - 1) / piece;
}

} // namespace lanecast
