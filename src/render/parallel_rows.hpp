#pragma once
// The rows of a picture shared out to threads, for the steps after the rendering.

#include <algorithm>
#include <thread>
#include <vector>

namespace lanecast {

/// Calls rows(first, last) on `threads` bands that cover [0, count), the last on the calling thread. `rows` does not throw.
template <class Rows>
void for_each_row_band(int count, int threads, const Rows& rows) {
    const int bands = std::clamp(threads, 1, std::max(1, count / 64)); // a thread costs what some tens of rows do
    const auto edge = [&](int band) { return static_cast<int>(static_cast<long long>(count) * band / bands); };
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(bands));
    for (int band = 0; band + 1 < bands; ++band)
        workers.emplace_back([&rows, first = edge(band), last = edge(band + 1)] { rows(first, last); });
    rows(edge(bands - 1), count);
}

} // namespace lanecast
