// Renders the Standard Procedural Databases by the renderer's own rules and prints what docs/spd.md publishes: processor time of
// one thread, best of some rounds, beside the published times. Not a test.
//
//     spd_times [rounds] [isa]

#include "render/dispatch.hpp"
#include "render/renderer.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

using namespace lanecast;

namespace {

/// Seconds; 0: not published.
struct Published {
    const char* name;
    double golem_grid, golem_octree; ///< Pentium II at 350 MHz, 1999: the best of all variants of either
    double hp835;                    ///< 1987, ray tracing alone
    double golem_rays;
};
constexpr Published published[] = {
    {"balls", 30.0, 33.8, 1496, 1402297},
    {"gears", 182.6, 206.6, 3751, 2845519},
    {"jacks", 0, 0, 0, 0},
    {"lattice", 34.2, 45.2, 0, 1687153},
    {"mount", 25.2, 28.3, 1129, 1334642},
    {"rings", 83.7, 86.5, 3221, 1653384},
    {"shells", 0, 0, 0, 0},
    {"teapot", 18.8, 23.0, 1538, 895744},
    {"tetra", 3.9, 4.9, 228, 309431},
    {"tree", 18.3, 29.9, 696, 1373492},
};

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double best_of(int rounds, Work&& work) {
    double best = 1e30;
    for (int round = 0; round < rounds; ++round) {
        const double start = processor_seconds();
        work();
        best = std::min(best, processor_seconds() - start);
    }
    return best;
}

std::string ratio(double theirs, double ours) {
    char text[40];
    std::snprintf(text, sizeof text, "%.0f", theirs / ours);
    return theirs > 0 ? text : "";
}

} // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
    const KernelTable& kernels = find_kernels(argc > 2 ? argv[2] : "auto", Precision::balanced);
    std::printf("%s\n| scene | tree ms | frame ms | rays | M rays/s | GOLEM M rays/s | times GOLEM's | the HP-835's |\n",
                kernels.isa);
    for (const Published& row : published) {
        const auto file = std::filesystem::path(LANECAST_SPD_DIR) / (std::string(row.name) + ".json");
        const SceneDescription scene = load_scene(file).description;
        SceneArrays arrays;
        const double tree = best_of(rounds, [&] { arrays = flatten(scene, scene.render, 1); });
        const FrameOptions options{.width = scene.camera.resolution[0], .height = scene.camera.resolution[1]};
        std::uint64_t rays = 0;
        const double frame = best_of(
            rounds, [&] { rays = ray_count(render_frame(kernels, arrays, scene.camera, scene.render, options).stats.tiles); });
        const double golem = row.golem_grid;
        std::printf("| %s | %.1f | %.1f | %llu | %.1f | %s | %s | %s |\n", row.name, 1e3 * tree, 1e3 * frame,
                    static_cast<unsigned long long>(rays), 1e-6 * static_cast<double>(rays) / frame,
                    golem > 0 ? std::to_string(row.golem_rays / golem * 1e-6).substr(0, 5).c_str() : "",
                    ratio(golem, frame).c_str(), ratio(row.hp835, frame).c_str());
    }
}
