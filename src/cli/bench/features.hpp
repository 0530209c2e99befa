#pragma once
// What it gives that kernels leave out what a scene does not use: frames as they are, in turn with frames that are told of one
// feature more, which nothing in the scene has. The pixels must be the same.

#include <cstdint>
#include <string>
#include <vector>

namespace lanecast::bench {

struct FeaturesRequest {
    std::string scene; ///< file
    std::string isa = "auto";
    std::string precision; ///< empty: the scene's
    int width = 1920, height = 1080;
    int pairs = 7;
};

/// Time with the feature over time without it.
struct FeatureRow {
    std::string feature;
    double gain = 0;                    ///< median of the pairs
    double low = 0, high = 0;           ///< quartiles
    double least = 0;                   ///< of the least time with it and the least time without
    std::uint64_t differing_pixels = 0; ///< in their bits: a fault
};

struct FeaturesReport {
    std::string scene, isa, precision, cpu, compiler, commit;
    int width = 0, height = 0, pairs = 0;
    double seconds = 0; ///< of processor time, one thread: the least of a frame as it is
    std::vector<FeatureRow> rows;
};

/// A row per feature that the scene leaves out, and one for all of them together. Throws Error.
[[nodiscard]] FeaturesReport measure_features(const FeaturesRequest& request);

[[nodiscard]] std::string text_report(const FeaturesReport& report);
[[nodiscard]] std::string json_report(const FeaturesReport& report);

} // namespace lanecast::bench
