#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lanecast::bench {

/// The nearest of the values, of which there is at least one.
template <class T>
[[nodiscard]] T quantile(std::vector<T> values, double share) {
    const auto place = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
    return values[place];
}

} // namespace lanecast::bench
