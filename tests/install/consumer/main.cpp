// The smallest user of the installed library: its headers compile alone, its kernels are found and its code links.
#include <render/dispatch.hpp>
#include <render/film.hpp>
#include <scene/description.hpp>

#include <cstdio>

int main() {
    lanecast::SceneDescription scene;
    scene.objects.push_back({lanecast::Sphere{}, {}, {}, "ball"});
    const auto& kernels = lanecast::find_kernels("auto", scene.render.precision);
    const lanecast::Film film = lanecast::make_film(4, 2, {0, 0, 4, 2});
    std::printf("%s: %d rays per vector, %zu pixels\n", kernels.isa, static_cast<int>(kernels.width), film.rgb[0].size());
    return film.rgb[0].size() == 8 ? 0 : 1;
}
