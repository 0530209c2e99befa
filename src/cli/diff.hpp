#pragma once
// lanecast diff a b: how far two pictures are from each other.

#include "render/compare.hpp"

#include <filesystem>
#include <iosfwd>
#include <optional>

namespace lanecast {

struct DiffOptions {
    std::filesystem::path a, b;               ///< EXR or PNG, told by their content
    std::filesystem::path output;             ///< difference picture of the pixels both hold, .exr or .png; empty: none
    std::optional<float> scale;               ///< of the difference picture; default 1 for EXR, 16 for PNG
    double threshold = default_off_threshold; ///< a pixel is off when a channel differs by more
    std::optional<double> max_rmse, max_error, max_off_share; ///< none given: any difference in the decoded pixels is one
};

/// Prints a table to `out`. 0: the same, or within the limits given; 1: not, or the pictures' sizes or windows differ. Throws
/// Error: asset for a picture that cannot be read, usage for an output of another kind, output.
[[nodiscard]] int run_diff(const DiffOptions& options, std::ostream& out);

} // namespace lanecast
