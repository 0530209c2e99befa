#pragma once
// The library: a scene of triangles, or from a file, and the closest or any hit of streams of rays. This header needs the
// standard library only and is the whole public interface; docs/library.md has an example.
//
// Points, tmin, tmax and t are in the caller's coordinates. Normalising them is the library's business.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace lanecast {

/// Triangles as the caller has them; copied, so they may go once the scene is built.
struct MeshArrays {
    const float* positions = nullptr; ///< x y z of the first vertex; magnitudes up to 1e30
    std::size_t vertex_count = 0;
    const std::uint32_t* indices = nullptr; ///< three per triangle, packed; null: every three vertices are a triangle
    std::size_t triangle_count = 0;
    std::size_t stride = 3 * sizeof(float); ///< bytes from one vertex to the next, a multiple of 4
};

struct BuildOptions {
    int threads = 0;                    ///< 0: the CPUs this process may use. The scene does not depend on it
    std::string isa = "auto";           ///< auto, scalar, sse4.2, avx2, avx512
    std::string bvh = "default";        ///< default, or quality: slower to build, faster where triangles are long and thin
    std::string precision = "balanced"; ///< fast (avx2, avx512), balanced, or in double: precise (not scalar), reference (scalar)
};

inline constexpr std::uint32_t no_hit = 0xffffffffu;

/// What the caller knows of neighbours in a stream; coherent: they go nearly the same way, as a camera's do. It changes the time,
/// never the answers.
enum class Coherence { unknown, coherent, incoherent };

/// Rays as a structure of arrays: each pointer to `count` floats of any alignment. Rays with a NaN, an infinite origin or
/// direction, a zero direction, or an origin 1e34 times the scene's size away hit nothing.
struct RayArrays {
    const float* org_x = nullptr;
    const float* org_y = nullptr;
    const float* org_z = nullptr;
    const float* dir_x = nullptr; ///< any length from 1e-18 to 1e18; distances are in units of it
    const float* dir_y = nullptr;
    const float* dir_z = nullptr;
    const float* tmin = nullptr; ///< a hit has t > tmin, and t > 0; null: 0
    const float* tmax = nullptr; ///< and t <= tmax; null: infinity
    std::size_t count = 0;
    bool common_origin = false; ///< all rays start at one point: org_x, org_y and org_z are one float each
    Coherence coherence = Coherence::unknown;
};

/// What to write, as a structure of arrays; null: not asked for. `t` may be the rays' `tmax`; nothing else that is written may
/// overlap what is read.
struct HitArrays {
    float* t = nullptr;                 ///< of the nearest hit; tmax for a miss
    std::uint32_t* object = nullptr;    ///< which of the meshes, or of the file's objects; no_hit for a miss
    std::uint32_t* primitive = nullptr; ///< which triangle of it, as the caller or the file numbers them; no_hit for a miss
    float* normal_x = nullptr;          ///< geometric, unit length: where the vertices turn counter-clockwise; 0 for a miss
    float* normal_y = nullptr;          ///< all three or none
    float* normal_z = nullptr;
    float* u = nullptr; ///< both or none: the point is (1 - u - v) v0 + u v1 + v v2; 0 for a miss and for what is no triangle
    float* v = nullptr;
};

struct SceneFacts {
    std::size_t triangles = 0;                    ///< that can be hit: degenerate ones are left out
    std::size_t primitives = 0;                   ///< triangles, and spheres, cylinders and planes of a file
    std::size_t bytes = 0;                        ///< held
    float bounds_min[3] = {}, bounds_max[3] = {}; ///< of all but planes; min > max where there is nothing
    std::string isa;                              ///< chosen
    double build_seconds = 0;                     ///< all of it, copies included
};

/// Immutable once built: any number of threads may trace at the same time.
class Scene {
public:
    /// Throws std::runtime_error for indices out of range, coordinates that are not finite, and an instruction set that the CPU
    /// or the build lacks; std::bad_alloc.
    explicit Scene(std::span<const MeshArrays> meshes, const BuildOptions& options = {});
    explicit Scene(const MeshArrays& mesh, const BuildOptions& options = {});
    /// A scene (.json) with all its objects, or a mesh (.obj, .ply). Throws the same, and std::runtime_error naming file, place
    /// and what was expected.
    explicit Scene(const std::filesystem::path& file, const BuildOptions& options = {});
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    void closest_hit(const RayArrays& rays, const HitArrays& hits) const noexcept;
    /// occluded[i]: 1 where ray i hits anything in its range, 0 where not.
    void any_hit(const RayArrays& rays, std::uint8_t* occluded) const noexcept;

    [[nodiscard]] SceneFacts facts() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace lanecast
