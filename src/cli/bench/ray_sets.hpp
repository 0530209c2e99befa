#pragma once
// The rays that are timed: made once per mesh from our own hits, the same for everybody.

#include "cli/bench/bench_mesh.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace lanecast::bench {

inline constexpr std::size_t chunk_rays = 1024; ///< timed together: a square of 32x32 pixels in Morton order, or what came of it

enum class Query { closest, any };

struct RaySet {
    std::string name;
    Query query = Query::closest;
    bool common_origin = false;
    Coherence coherence = Coherence::unknown;
    std::vector<float> org[3], dir[3];
    float tmax = 0; ///< of every ray

    [[nodiscard]] std::size_t size() const { return dir[0].size(); }
    [[nodiscard]] std::size_t chunks() const { return (size() + chunk_rays - 1) / chunk_rays; }
    [[nodiscard]] std::size_t chunk_size(std::size_t chunk) const { return std::min(chunk_rays, size() - chunk * chunk_rays); }
    void add(const glm::dvec3& o, const glm::dvec3& d) {
        for (int axis = 0; axis < 3; ++axis) {
            org[axis].push_back(static_cast<float>(o[axis]));
            dir[axis].push_back(static_cast<float>(d[axis]));
        }
    }
};

/// The kinds of rays, in the order of the tables:
///   primary   through the centres of the pixels of 1920x1080
///   aa        four offsets (.25, 1.25) (1.25, -.25) (-.25, -1.25) (-1.25, .25), a pixel's four adjacent
///   shadow    from the hits that face it to a point light, any hit
///   light     the same segments from the light
///   sun       from the hits that face it to a directional light, any hit
///   mirror    reflected about the geometric normal
///   diffuse   cosine-distributed about it
[[nodiscard]] const std::vector<std::string>& ray_kinds();

/// Of each of `kinds`, about `count` rays or as many as there are. `scene` holds the mesh.
[[nodiscard]] std::vector<RaySet> make_ray_sets(const BenchMesh& mesh, const Scene& scene, const std::vector<std::string>& kinds,
                                                std::size_t count);

} // namespace lanecast::bench
