// A user of the installed library: a scene from a file, and every kernel it holds.
#include <lanecast/lanecast.hpp>

#include <cstdio>
#include <stdexcept>

int main(int, char** argv) {
    const float org[3] = {0, 0, 9}, dir[3] = {0, 0, -1};
    lanecast::RayArrays rays{&org[0], &org[1], &org[2], &dir[0], &dir[1], &dir[2]};
    rays.count = 1;
    int used = 0;
    for (const char* isa : {"scalar", "sse4.2", "avx2", "avx512"}) {
        float t = 0;
        std::uint8_t occluded = 0;
        try {
            const lanecast::Scene scene(std::filesystem::path(argv[1]), {.isa = isa});
            scene.closest_hit(rays, {&t});
            scene.any_hit(rays, &occluded);
        } catch (const std::runtime_error& error) { // this build or this CPU lacks it
            std::printf("%s\n", error.what());
            continue;
        }
        ++used;
        if (t != 8 || occluded != 1) return 1;
    }
    return used > 0 ? 0 : 1;
}
