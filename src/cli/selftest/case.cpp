#include "cli/selftest/case.hpp"

#include "cli/print.hpp"
#include "render/dispatch.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {
namespace {

constexpr int classes_per_octave = 16;

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

} // namespace

const char* name_of(Placing placing) {
    constexpr const char* names[] = {"plain", "translated", "rotated", "scaled", "stretched", "mirrored"};
    return names[static_cast<std::size_t>(placing)];
}

const char* name_of(Path path) {
    constexpr const char* names[] = {"batch", "mixed", "single"};
    return names[static_cast<std::size_t>(path)];
}

std::string text_of(const Setting& setting) {
    constexpr const char* kinds[] = {"triangles", "spheres", "ellipsoids", "cylinders", "cones", "open cones", "planes"};
    return std::string(setting.kernels->isa) + " " + name_of(setting.kernels->precision) + ", " +
           kinds[static_cast<std::size_t>(setting.primitive)] + ", " + name_of(setting.placing) + ", leaves of " +
           std::to_string(setting.leaf_size) + ", " + name_of(setting.path);
}

void Tally::add_error(double error) {
    if (!(error >= 0)) error = std::numeric_limits<double>::infinity(); // a NaN is the largest error there is
    worst = std::max(worst, error);
    const double place = error <= 1e-30 ? -1600 : error >= 1e30 ? 1600 : std::ceil(std::log2(error) * classes_per_octave);
    ++errors[static_cast<int>(place)];
}

double Tally::percentile(double share) const {
    std::uint64_t count = 0;
    for (const auto& [place, n] : errors) count += n;
    const double wanted = share * static_cast<double>(count);
    std::uint64_t below = 0;
    for (const auto& [place, n] : errors) {
        below += n;
        if (static_cast<double>(below) >= wanted)
            return place == -1600 ? 0 : std::min(worst, std::exp2(double(place) / classes_per_octave));
    }
    return 0;
}

void Tally::add(const Tally& later) {
    rays += later.rays;
    if (failures == 0) example = later.example;
    failures += later.failures;
    worst = std::max(worst, later.worst);
    for (const auto& [place, n] : later.errors) errors[place] += n;
}

double Tally::mean() const {
    double sum = 0, count = 0;
    for (const auto& [place, n] : errors) {
        const auto times = static_cast<double>(n);
        sum += place == -1600 ? 0 : times * std::exp2(double(place) / classes_per_octave);
        count += times;
    }
    return count > 0 ? sum / count : 0;
}

bool is_met(const Target& target, const Tally& tally) {
    return static_cast<double>(tally.failures) <= target.failure_rate * static_cast<double>(tally.rays) &&
           tally.worst <= target.worst && tally.percentile(0.99) <= target.p99 * 1.0000001 &&
           tally.percentile(0.5) <= target.median * 1.0000001 &&
           (target.mean == std::numeric_limits<double>::infinity() || tally.mean() <= target.mean);
}

std::string text_of(const Target& target) {
    std::string text = target.failure_rate == 0 ? "0" : "<= " + short_number(target.failure_rate);
    const auto add = [&](const char* what, double limit) {
        if (limit < std::numeric_limits<double>::infinity())
            text += std::string(", ") + what + " <= " + short_number(limit) + (*target.unit ? " " : "") + target.unit;
    };
    add("worst", target.worst);
    add("p99", target.p99);
    add("mean", target.mean);
    add("median", target.median);
    if (target.listed) text += " (listed)";
    return text;
}

} // namespace lanecast::selftest
