// The rays of the Standard Procedural Databases, at their published sizes, against the published counts (docs/spd.md).

#include "golden/spd_rays.hpp"
#include "render/dispatch.hpp"
#include "scene/load_scene.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

using namespace lanecast;
using namespace lanecast::test;

namespace {

/// Havran and Sixta 1999, GOLEM.
struct Golem {
    const char* name;
    double eye_hits, shadow, blocked, secondary, secondary_hits, all;
};
constexpr Golem golem[] = {
    {"balls", 263169, 959244, 285178, 179884, 134368, 1402297},
    {"gears", 245332, 2088012, 1057557, 494338, 365338, 2845519},
    {"lattice", 261170, 1180774, 943159, 243210, 178786, 1687153},
    {"mount", 173685, 361037, 74555, 710436, 472351, 1334642},
    {"rings", 263169, 1077336, 510719, 312879, 175688, 1653384},
    {"teapot", 161546, 406340, 34757, 226235, 67688, 895744},
    {"tetra", 49950, 46262, 5538, 0, 0, 309431},
    {"tree", 169907, 1110323, 47506, 0, 0, 1373492},
};

/// Haines' own, with the databases.
struct Haines {
    const char* name;
    double eye_hits, reflected, refracted, shadow;
};
constexpr Haines haines[] = {
    {"balls", 263169, 175095, 0, 954368},  {"gears", 245086, 304643, 207564, 2246955}, {"mount", 173125, 354769, 354769, 412922},
    {"rings", 263169, 315236, 0, 1085002}, {"teapot", 161120, 225248, 0, 407656},      {"tetra", 49788, 0, 0, 46112},
    {"tree", 169836, 0, 0, 1097419},
};

SpdCounts count(const std::string& name, Facing facing) {
    const SceneDescription scene = load_scene(std::filesystem::path(LANECAST_SPD_DIR) / (name + ".json")).description;
    SpdRules rules;
    rules.one_sided = name != "teapot"; // whose rules ask for two sides
    rules.facing = facing;
    return count_spd_rays(scene, rules, find_kernels("auto", Precision::balanced));
}

void compare(const char* what, std::uint64_t found, double published) {
    std::printf("  %-16s %9llu  %9.0f  %+6.1f %%\n", what, static_cast<unsigned long long>(found), published,
                published > 0 ? 100 * (static_cast<double>(found) / published - 1) : 0.0);
    INFO(what, ": ", found, ", published ", published);
    CHECK(std::abs(static_cast<double>(found) - published) <= 0.1 * published);
}

} // namespace

TEST_CASE("as many rays as GOLEM's, within 10 % per count") {
    for (const Golem& row : golem) {
        CAPTURE(std::string(row.name));
        std::printf("%s: found, GOLEM's\n", row.name);
        const SpdCounts counts = count(row.name, Facing::front);
        compare("eye hits", counts.eye_hits, row.eye_hits);
        compare("shadow", counts.shadow, row.shadow);
        compare("blocked", counts.blocked, row.blocked);
        compare("secondary", counts.secondary(), row.secondary);
        compare("secondary hits", counts.secondary_hits, row.secondary_hits);
        compare("all", counts.all(), row.all);
    }
}

TEST_CASE("as many rays as Haines', within 10 % per count") {
    for (const Haines& row : haines) {
        CAPTURE(std::string(row.name));
        std::printf("%s: found, Haines'\n", row.name);
        const SpdCounts counts = count(row.name, Facing::seen);
        compare("eye hits", counts.eye_hits, row.eye_hits);
        compare("reflected", counts.reflected, row.reflected);
        compare("refracted", counts.refracted, row.refracted);
        compare("shadow", counts.shadow, row.shadow);
    }
}
