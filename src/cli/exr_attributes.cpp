#include "cli/render_report.hpp"

#include "cli/settings_options.hpp"
#include "scene/text_tools.hpp"

#include <chrono>
#include <ctime>

#include <unistd.h>

namespace lanecast {
namespace {

constexpr const char* ray_names[ray_kind_count] = {"primaryRays", "offsetRays", "shadowRays", "reflectionRays", "refractionRays"};

std::string host_name() {
    char name[256] = {};
    return ::gethostname(name, sizeof name - 1) == 0 ? printable(name, 255) : "";
}

std::string utc_now() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

} // namespace

std::vector<ExrAttribute> exr_attributes(const RenderReport& report, bool volatile_metadata) {
    std::vector<ExrAttribute> attributes = {
        {"lanecast:scene", printable(report.scene, 4096)},
        {"lanecast:version", std::string(LANECAST_VERSION)},
        {"lanecast:settings", settings_json(report.settings)},
    };
    if (!volatile_metadata) return attributes;
    const auto add = [&](const char* name, auto value) { attributes.push_back({std::string("lanecast:") + name, value}); };
    if (!report.budget.empty()) add("budget", report.budget); // the same settings given by hand make the same file but for this
    add("isa", report.isa);
    add("threads", report.stats.threads);
    add("loadSeconds", report.load_seconds);
    add("flattenSeconds", report.flatten_seconds);
    add("buildSeconds", report.build_seconds);
    add("renderSeconds", report.stats.seconds);
    for (int kind = 0; kind < ray_kind_count; ++kind) // double: an int attribute holds 32 bits
        add(ray_names[kind], static_cast<double>(report.stats.tiles.kinds[kind].rays));
    add("host", host_name());
    add("date", utc_now());
    return attributes;
}

} // namespace lanecast
