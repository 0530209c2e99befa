#include "cli/bench/calls.hpp"

#include "cli/bench/measure.hpp"
#include "cli/print.hpp"
#include "lanecast/describe.hpp"
#include "render/dispatch.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <functional>

namespace lanecast::bench {
namespace {

constexpr std::size_t lengths[] = {1, 16, 512, 65536};

constexpr std::size_t piece = 8192; ///< rays whose calls are timed together, or one call if it is longer

constexpr std::size_t pieces = 4; ///< spread over the picture

/// Seconds per ray of `call(begin, count)` in streams of `length`: the sum of the least time of each piece.
double seconds_per_ray(std::size_t rays, std::size_t length, int repetitions,
                       const std::function<void(std::size_t, std::size_t)>& call) {
    const std::size_t size = std::min(std::max(piece, length), rays / pieces);
    double sum = 0;
    for (std::size_t k = 0; k < pieces; ++k) {
        const std::size_t begin = k * (rays / pieces), end = begin + size;
        std::uint64_t least = ~0ull;
        for (int r = 0; r <= repetitions; ++r) {
            const std::uint64_t start = __builtin_ia32_rdtsc();
            for (std::size_t i = begin; i < end; i += length) call(i, std::min(length, end - i));
            least = std::min<std::uint64_t>(least, __builtin_ia32_rdtsc() - start);
        }
        sum += static_cast<double>(least);
    }
    return sum / ticks_per_second() / static_cast<double>(pieces * size);
}

struct Outputs {
    std::vector<float> t, normal[3], u, v;
    std::vector<std::int32_t> slot;
    std::vector<std::uint32_t> object, primitive;
    explicit Outputs(std::size_t n) : t(n), normal{t, t, t}, u(n), v(n), slot(n), object(n), primitive(n) {}
};

std::string measure_scene(const std::string& name, const MeshArrays& arrays, const RaySet& rays, const std::string& isa,
                          int repetitions) {
    const BuildOptions options{.threads = 0, .isa = isa, .bvh = "default", .precision = "balanced"};
    const Scene scene(arrays, options);
    const SceneDescription description = describe(std::span(&arrays, 1));
    const SceneArrays flat = flatten(description, description.render, 1);
    const SceneView flat_view = view(flat);
    const KernelTable& kernels = find_kernels(isa, Precision::balanced);
    std::vector<float> normalised[3];
    for (int axis = 0; axis < 3; ++axis)
        for (const float o : rays.org[axis])
            normalised[axis].push_back(
                static_cast<float>((static_cast<double>(o) - flat.normalisation.centre[axis]) * flat.normalisation.scale));
    Outputs out(rays.size());
    RayArrays asked;
    const auto ask = [&](std::size_t begin, std::size_t count, bool common_origin) {
        const std::size_t first_org = common_origin ? 0 : begin;
        asked.org_x = rays.org[0].data() + first_org;
        asked.org_y = rays.org[1].data() + first_org;
        asked.org_z = rays.org[2].data() + first_org;
        asked.dir_x = rays.dir[0].data() + begin;
        asked.dir_y = rays.dir[1].data() + begin;
        asked.dir_z = rays.dir[2].data() + begin;
        asked.count = count;
        asked.common_origin = common_origin;
    };
    const auto kernel = [&](std::size_t begin, std::size_t count) {
        RayStream stream{};
        for (int axis = 0; axis < 3; ++axis) {
            stream.org[axis] = normalised[axis].data() + begin;
            stream.dir[axis] = rays.dir[axis].data() + begin;
        }
        stream.t = out.t.data() + begin;
        stream.slot = out.slot.data() + begin;
        stream.count = static_cast<std::uint32_t>(count);
        kernels.closest_hit(flat_view, stream);
    };
    const auto library = [&](std::size_t begin, std::size_t count) {
        ask(begin, count, false);
        HitArrays hits;
        hits.t = out.t.data() + begin;
        hits.primitive = out.primitive.data() + begin;
        scene.closest_hit(asked, hits);
    };
    const auto common_origin = [&](std::size_t begin, std::size_t count) {
        ask(begin, count, true);
        HitArrays hits;
        hits.t = out.t.data() + begin;
        hits.primitive = out.primitive.data() + begin;
        scene.closest_hit(asked, hits);
    };
    const auto everything = [&](std::size_t begin, std::size_t count) {
        ask(begin, count, false);
        scene.closest_hit(asked, {out.t.data() + begin, out.object.data() + begin, out.primitive.data() + begin,
                                  out.normal[0].data() + begin, out.normal[1].data() + begin, out.normal[2].data() + begin,
                                  out.u.data() + begin, out.v.data() + begin});
    };
    struct Way {
        const char* name;
        std::function<void(std::size_t, std::size_t)> call;
    };
    const Way ways[] = {{"kernels: t, slot", kernel},
                        {"library: t, primitive", library},
                        {"  with a common origin", common_origin},
                        {"  and object, normal, u, v", everything}};
    std::string text;
    for (const Way& way : ways) {
        std::string line = name + ", " + way.name;
        line.resize(std::max<std::size_t>(line.size(), 44), ' ');
        for (const std::size_t length : lengths) {
            const std::string number = fixed(1e9 * seconds_per_ray(rays.size(), length, repetitions, way.call), 2);
            line += std::string(10 - std::min<std::size_t>(9, number.size()), ' ') + number;
        }
        text += line + "\n";
    }
    return text;
}

} // namespace

std::string measure_calls(const BenchMesh& mesh, const std::string& isa, int repetitions) {
    const Scene scene(mesh.arrays());
    const RaySet rays = make_ray_sets(mesh, scene, {"primary"}, pieces * lengths[3])[0];
    std::string text = "nanoseconds per ray, " + isa + ", in streams of" + std::string(12, ' ');
    for (const std::size_t length : lengths) {
        const std::string number = std::to_string(length);
        text += std::string(10 - number.size(), ' ') + number;
    }
    return text + "\n" + measure_scene(mesh.name, mesh.arrays(), rays, isa, repetitions) +
           measure_scene("an empty scene", {}, rays, isa, repetitions);
}

} // namespace lanecast::bench
