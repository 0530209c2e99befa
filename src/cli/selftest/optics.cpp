// N16 to N18: light that is conserved, mirrors without end, the angle at which glass turns into a mirror.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/oracle.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "render/camera.hpp"
#include "render/dispatch.hpp"
#include "render/tiles.hpp"
#include "scene/aligned_bytes.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <sys/resource.h>

namespace lanecast::selftest {
namespace {

/// Objects of all sizes in a white room without walls: whatever light does there, it is white.
SceneDescription white_scene(const Setting& s, Random& random) {
    SceneDescription scene = random_lit_scene(s.primitive, s.placing, 4 + random.below(12), random);
    scene.lights.clear();
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    scene.camera.background = {1, 1, 1};
    return scene;
}

constexpr int edge = 48; ///< of pictures, in pixels

} // namespace

/// Ambient light on white surfaces, and mirrors, are white.
void test_furnace(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        SceneDescription scene = white_scene(s, random);
        for (Object& object : scene.objects) {
            object.material = Material{};
            if (random.chance(0.5))
                object.material.ambient = glm::dvec3(1);
            else
                object.material.reflective = glm::dvec3(1);
        }
        RenderSettings settings;
        settings.depth = 100;
        const SceneArrays arrays = with_leaves_of(flatten(scene, settings, 1), s.leaf_size);
        const Picture picture = render(*s.kernels, arrays, scene.camera, settings, edge, edge);
        for (const auto& plane : picture.film.rgb)
            for (const float value : plane) tally.add_error(ulps(value, 1));
        return picture.rays();
    });
}

/// Glass that mirrors what it does not let through gives no light of its own.
void test_glass_furnace(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        SceneDescription scene = white_scene(s, random);
        for (Object& object : scene.objects) {
            object.material = Material{};
            object.material.reflective = glm::dvec3(1);
            const double t = random.uniform(0, 1); // channels nearly alike: else both children's weights add up to more than 1
            for (int c = 0; c < 3; ++c) object.material.transmissive[c] = std::clamp(t + random.uniform(-0.02, 0.02), 0.0, 1.0);
            object.material.refraction = random.uniform(1, 2.5);
        }
        RenderSettings settings;
        settings.depth = 100;
        settings.cutoff = 0.05;
        settings.schlick = random.chance(0.5);
        const SceneArrays arrays = with_leaves_of(flatten(scene, settings, 1), s.leaf_size);
        const Picture picture = render(*s.kernels, arrays, scene.camera, settings, edge / 2, edge / 2);
        for (const auto& plane : picture.film.rgb)
            for (const float value : plane) {
                tally.worst = std::max(tally.worst, double{value} - 1);
                if (!(value >= 0.0f && value <= 1.000001f)) tally.fail("a pixel is " + std::to_string(value));
            }
        return picture.rays();
    });
}

namespace {

/// The cube from -1 to 1.
SceneDescription mirror_cube(PrimitiveKind kind) {
    SceneDescription scene;
    Material mirror;
    mirror.reflective = glm::dvec3(1);
    if (kind == PrimitiveKind::plane) {
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                glm::dvec3 p(0);
                p[axis] = side;
                add_object(scene, Plane{p, -p}, {}, mirror);
            }
    } else {
        add_object(scene, closed_mesh(Form::gridded_box, 1), {}, mirror);
    }
    return scene;
}

/// What a ray does there, in 64 bits of mantissa: from wall to wall, one component of its direction turned round at each.
class ExactPath {
public:
    ExactPath(const glm::vec3& org, const glm::vec3& dir, Real half_edge) : half_edge_(half_edge) {
        for (int k = 0; k < 3; ++k) {
            at[k] = Real{org[k]};
            dir_[k] = Real{dir[k]};
        }
    }
    /// To the next wall; true if the normal there is the given one.
    bool meets(const float (&normal)[3]) {
        int axis = 0;
        Real t = std::numeric_limits<Real>::infinity();
        for (int k = 0; k < 3; ++k)
            if (const Real to_wall = (std::copysign(half_edge_, dir_[k]) - at[k]) / dir_[k]; to_wall < t) {
                t = to_wall;
                axis = k;
            }
        for (int k = 0; k < 3; ++k) at[k] += t * dir_[k];
        at[axis] = std::copysign(half_edge_, dir_[axis]);
        dir_[axis] = -dir_[axis];
        return Real{normal[axis]} * std::copysign(Real{1}, dir_[axis]) == 1;
    }
    Real at[3];

private:
    Real dir_[3], half_edge_;
};

constexpr std::int32_t mirrorings = 1000;

/// The rays of a picture of one pixel; memory is kept from path to path, most of which a path of 1000 levels touches.
class PathTracer {
public:
    explicit PathTracer(const KernelTable& kernels) : kernels_(kernels), records_(mirrorings + 8) {}

    /// The camera's first.
    std::span<const TraceRecord> trace(const SceneArrays& scene, const glm::vec3& org, const glm::vec3& dir) {
        RenderSettings settings;
        settings.depth = mirrorings;
        FrameOptions options;
        options.width = options.height = options.tile_size = 1;
        RenderJob job = make_job(scene, Camera{}, settings, options);
        for (int k = 0; k < 3; ++k) {
            job.camera.org[k] = org[k];
            job.camera.forward[k] = dir[k]; // and the pixel's centre is the picture's
        }
        const PixelOrder order = morton_order(1);
        job.pixel_order[0] = order.x.data();
        job.pixel_order[1] = order.y.data();
        job.pixel_order_count = order.count;
        const Tile pixel{0, 0, 1, 1};
        Film film = make_film(1, 1, pixel);
        job.film = view(film);
        TraceLight light{};
        TraceLog log{.rays = records_.data(),
                     .lights = &light,
                     .ray_capacity = static_cast<std::int32_t>(records_.size()),
                     .light_capacity = 1,
                     .ray_count = 0,
                     .light_count = 0};
        job.log = &log;
        if (const std::uint64_t bytes = kernels_.scratch_bytes(job); bytes > bytes_) {
            scratch_ = make_aligned_bytes(bytes);
            bytes_ = bytes;
        }
        static_cast<void>(kernels_.render_tile(job, pixel, scratch_.get()));
        return std::span(records_).first(std::min(static_cast<std::size_t>(log.ray_count), records_.size()));
    }

private:
    const KernelTable& kernels_;
    std::vector<TraceRecord> records_;
    AlignedBytes scratch_;
    std::uint64_t bytes_ = 0;
};

} // namespace

/// A thousand mirrorings, from the same floats. Failure: another face; error: of the last point, in half edges.
void test_mirror_cube(const Block& block, Tally& tally) {
    Random random(block.seed);
    const SceneArrays scene = flatten(mirror_cube(block.setting.primitive), RenderSettings{}, 1);
    const double half_edge = scene.normalisation.scale;
    PathTracer ours(*block.setting.kernels);
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    for (std::uint64_t path = 0; path * mirrorings < block.rays; ++path) {
        const glm::vec3 org(random.point(0.9 * half_edge)), dir(random.direction());
        const std::span<const TraceRecord> records = ours.trace(scene, org, dir);
        ExactPath exact(org, dir, Real{half_edge});
        tally.rays += 1; // paths: what the target counts
        std::size_t k = 0;
        while (k < records.size() && records[k].slot >= 0 && exact.meets(records[k].normal)) ++k;
        if (k <= mirrorings) {
            tally.fail("another face after " + std::to_string(k) + " mirrorings");
            continue;
        }
        Real error = 0;
        for (int axis = 0; axis < 3; ++axis)
            error = std::max(error, std::fabs(Real{records[mirrorings].point[axis]} - exact.at[axis]));
        tally.add_error(static_cast<double>(error) / half_edge);
    }
    ::getrusage(RUSAGE_SELF, &after);
    if (after.ru_maxrss - before.ru_maxrss > 256 * 1024) tally.fail("memory grew by more than 256 MiB");
}

namespace {

/// Schlick's term for a ray from index n1 into n2, and how far a kernel's may be off: `cosine` is off by a few roundings, and
/// near the critical angle the cosine of the other side by the root of them.
struct Fresnel {
    double value, slack;
    bool total;
};
Fresnel schlick(double n1, double n2, double cosine) {
    const double sine2 = (1 - cosine * cosine) * (n1 / n2) * (n1 / n2),
                 rounding = 16 * 0x1p-24 * std::max(1.0, n1 * n1 / (n2 * n2));
    const double k = 1 - sine2;
    if (n1 > n2 && k <= 0) return {1, std::fabs(k) <= rounding ? 5 * std::sqrt(rounding) : 0, true};
    const double c = 1 - (n1 > n2 ? std::sqrt(k) : cosine), r0 = (n1 - n2) / (n1 + n2) * ((n1 - n2) / (n1 + n2));
    const double moved = n1 > n2 ? std::min(std::sqrt(rounding), rounding / std::sqrt(std::max(k, 1e-30))) : 8 * 0x1p-24;
    return {r0 + (1 - r0) * std::pow(c, 5), 5 * moved + 8 * 0x1p-24, false};
}

} // namespace

/// A glass plane that mirrors a white sky, from either side: each pixel is the share that is mirrored.
void test_fresnel(const Block& block, Tally& tally) {
    for_each_picture(block, tally, [&](Random& random) {
        SceneDescription scene;
        Material glass;
        glass.reflective = glm::dvec3(1);
        glass.refraction = random.uniform(1.05, 3);
        const bool inside = random.chance(0.5);
        add_object(scene, Plane{{0, 0, 0}, {0, inside ? -1 : 1, 0}}, {}, glass);
        Camera& camera = scene.camera;
        camera.background = {1, 1, 1};
        camera.position = {0, 1, 0};
        const double critical = inside ? std::asin(1 / glass.refraction) : 1.3, tilt = std::min(critical, 1.5);
        camera.look_at = camera.position + glm::dvec3(std::sin(tilt), -std::cos(tilt), 0);
        camera.up = {0, 0, 1};
        camera.field = random.magnitude(0.01, 60);
        RenderSettings settings;
        settings.schlick = true;
        const SceneArrays arrays = flatten(scene, settings, 1);
        const Picture picture = render(*block.setting.kernels, arrays, camera, settings, edge, edge);
        const CameraRecord record = make_camera(camera, arrays.normalisation, edge, edge);
        const double n = static_cast<double>(static_cast<float>(glass.refraction));
        struct Angle {
            double cosine;
            float found;
            Fresnel exact;
        };
        std::vector<Angle> angles;
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const double sx = (x + 0.5 - 0.5 * edge) * double{record.pixel},
                             sy = (0.5 * edge - (y + 0.5)) * double{record.pixel};
                glm::dvec3 d;
                for (int axis = 0; axis < 3; ++axis)
                    d[axis] = double{record.forward[axis]} + sx * double{record.right[axis]} + sy * double{record.up[axis]};
                const double cosine = -d.y / glm::length(d);
                if (cosine <= 1e-6) continue; // past the horizon
                const float found = picture.film.rgb[0][static_cast<std::size_t>(y * edge + x)];
                angles.push_back({cosine, found, schlick(inside ? n : 1, inside ? 1 : n, cosine)});
            }
        for (const Angle& a : angles) {
            if (!(a.found >= 0.0f && a.found <= 1.0f)) tally.fail("the share is " + std::to_string(a.found));
            const double off = std::fabs(double{a.found} - a.exact.value);
            tally.worst = std::max(tally.worst, off - a.exact.slack);
            if (off > a.exact.slack)
                tally.fail((a.exact.total ? "total reflection: " : "share: ") + std::to_string(a.found) + " instead of " +
                           std::to_string(a.exact.value) + " at cosine " + std::to_string(a.cosine));
        }
        std::sort(angles.begin(), angles.end(), [](const Angle& a, const Angle& b) { return a.cosine < b.cosine; });
        for (std::size_t i = 1; i < angles.size(); ++i)
            if (double{angles[i].found} > double{angles[i - 1].found} + angles[i].exact.slack + angles[i - 1].exact.slack)
                tally.fail("the share grows with a steeper angle at cosine " + std::to_string(angles[i].cosine));
        return picture.rays();
    });
}

} // namespace lanecast::selftest
