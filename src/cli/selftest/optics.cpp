// N16 to N18: light that is conserved, mirrors without end, the angle at which glass turns into a mirror.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/meshes.hpp"
#include "cli/selftest/objects.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "render/camera.hpp"
#include "render/dispatch.hpp"
#include "render/tiles.hpp"
#include "scene/aligned_bytes.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>

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
            object.material.transmissive = glm::dvec3(random.uniform(0, 1));
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

SceneDescription mirror_cube(PrimitiveKind kind, Random& random) {
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
    scene.camera.position = random.point(0.5);
    scene.camera.look_at = scene.camera.position + random.direction();
    scene.camera.up = random.direction();
    return scene;
}

int face_of(const TraceRecord& record) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::fabs(record.normal[k]) > std::fabs(record.normal[axis])) axis = k;
    return 2 * axis + (record.normal[axis] < 0 ? 0 : 1);
}

/// The rays of single pixels; memory is kept from pixel to pixel, most of which a path of 1000 levels touches.
class PathTracer {
public:
    explicit PathTracer(const KernelTable& kernels) : kernels_(kernels), records_(levels + 8) {}

    const std::vector<TraceRecord>& trace(const SceneArrays& scene, const Camera& camera, const RenderSettings& settings, int x,
                                          int y) {
        FrameOptions options;
        options.width = options.height = 16;
        options.tile_size = 1;
        RenderJob job = make_job(scene, camera, settings, options);
        const PixelOrder order = morton_order(1);
        job.pixel_order[0] = order.x.data();
        job.pixel_order[1] = order.y.data();
        job.pixel_order_count = order.count;
        const Tile pixel{x, y, x + 1, y + 1};
        Film film = make_film(16, 16, pixel);
        job.film = view(film);
        TraceLight light{};
        TraceLog log{.rays = records_.data(),
                     .lights = &light,
                     .ray_capacity = levels + 8,
                     .light_capacity = 1,
                     .ray_count = 0,
                     .light_count = 0};
        job.log = &log;
        if (const std::uint64_t bytes = kernels_.scratch_bytes(job); bytes > bytes_) {
            scratch_ = make_aligned_bytes(bytes);
            bytes_ = bytes;
        }
        static_cast<void>(kernels_.render_tile(job, pixel, scratch_.get()));
        count = std::min(log.ray_count, levels + 8);
        return records_;
    }
    static constexpr std::int32_t levels = 1001;
    std::int32_t count = 0; ///< of the last path

private:
    const KernelTable& kernels_;
    std::vector<TraceRecord> records_;
    AlignedBytes scratch_;
    std::uint64_t bytes_ = 0;
};

} // namespace

/// A thousand mirrorings against the same in double. Failure: another face; error: of the last point, in half edges.
void test_mirror_cube(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    PathTracer ours(*s.kernels), exact(find_kernels("auto", Precision::reference));
    RenderSettings settings;
    settings.depth = 1000;
    std::uint64_t rays = 0;
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    while (rays < block.rays) {
        const SceneDescription scene = mirror_cube(s.primitive, random);
        const SceneArrays arrays = flatten(scene, settings, 1);
        for (int pixel = 0; pixel < 16; ++pixel) {
            const int x = random.below(16), y = random.below(16);
            const auto& a = ours.trace(arrays, scene.camera, settings, x, y);
            const auto& b = exact.trace(arrays, scene.camera, settings, x, y);
            rays += PathTracer::levels;
            tally.rays += 1; // paths: what the target counts
            const auto length = static_cast<std::size_t>(std::min(ours.count, exact.count));
            std::size_t k = 0;
            while (k < length && (a[k].slot < 0) == (b[k].slot < 0) && face_of(a[k]) == face_of(b[k])) ++k;
            if (k < 1001) {
                tally.fail("another face after " + std::to_string(k) + " mirrorings");
                continue;
            }
            double error = 0;
            for (int axis = 0; axis < 3; ++axis)
                error = std::max(error, std::fabs(double{a[1000].point[axis]} - double{b[1000].point[axis]}));
            tally.add_error(error / arrays.normalisation.scale);
        }
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
