// Which of two triangles does each ray of a picture see?
#include <lanecast/lanecast.hpp>

#include <cstdio>
#include <vector>

int main() {
    const float positions[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, -1, 0, -1, 1, 0, -1, 0, 2, -1}; // x y z of six vertices
    const std::uint32_t indices[] = {0, 1, 2, 3, 4, 5};
    const lanecast::Scene scene({positions, 6, indices, 2}); // throws std::runtime_error

    constexpr int width = 48, height = 24;
    std::vector<float> x, y, z; // directions: one array per axis, of any length
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            x.push_back((i + 0.5f) / width - 0.5f);
            y.push_back(0.5f - (j + 0.5f) / height);
            z.push_back(-1);
        }
    const float eye[3] = {0, 0.5f, 3};
    lanecast::RayArrays rays{&eye[0], &eye[1], &eye[2], x.data(), y.data(), z.data()};
    rays.count = x.size();
    rays.common_origin = true; // so the origin is one point

    std::vector<float> t(rays.count);
    std::vector<std::uint32_t> triangle(rays.count);
    lanecast::HitArrays hits; // what is null is not computed
    hits.t = t.data();
    hits.primitive = triangle.data();
    scene.closest_hit(rays, hits); // any number of threads may do this at the same time

    for (std::size_t i = 0; i < rays.count; ++i)
        std::printf("%c%s", triangle[i] == lanecast::no_hit ? '.' : triangle[i] == 0 ? '#' : 'o', (i + 1) % width ? "" : "\n");
}
