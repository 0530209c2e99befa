#pragma once
// The rows of a picture shared out to threads, for the steps after the rendering.

#include "scene/parallel.hpp"

#include <algorithm>

namespace lanecast {

/// Calls rows(first, last) on up to `threads` bands that cover [0, count).
template <class Rows>
void for_each_row_band(int count, int threads, const Rows& rows) {
    const int bands = std::clamp(threads, 1, std::max(1, count / 64)); // a thread costs what some tens of rows do
    const auto edge = [&](std::size_t band) {
        return static_cast<int>(static_cast<long long>(count) * static_cast<long long>(band) / bands);
    };
    parallel_for(bands, static_cast<std::size_t>(bands), [&](std::size_t band) { rows(edge(band), edge(band + 1)); });
}

} // namespace lanecast
