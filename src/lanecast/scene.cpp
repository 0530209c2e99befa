#include "lanecast/lanecast.hpp"

#include "lanecast/describe.hpp"
#include "render/dispatch.hpp"
#include "scene/error.hpp"
#include "scene/flatten.hpp"
#include "scene/thread_count.hpp"
#include "scene/transform.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <vector>

namespace lanecast {

namespace {

using Clock = std::chrono::steady_clock;

BvhMode bvh_of(const std::string& name) {
    if (name == "default") return BvhMode::standard;
    if (name == "quality") return BvhMode::quality;
    throw Error(ExitCode::usage, "bvh '" + name + "' does not exist; expected default or quality");
}

/// Empty for a single object that is not mirrored: scene ids are its own numbering.
std::vector<StreamObject> number_objects(const SceneDescription& description) {
    std::vector<StreamObject> objects;
    std::uint32_t first = 0;
    for (const Object& object : description.objects) {
        objects.push_back({first, is_mirroring(compose(object.transformations).linear) ? 1u : 0u});
        const auto* mesh = std::get_if<Mesh>(&object.shape);
        first += mesh != nullptr ? static_cast<std::uint32_t>(mesh->triangles.size()) : 1u;
    }
    if (objects.size() == 1 && objects[0].mirrored == 0) objects.clear();
    return objects;
}

template <class Data>
std::unique_ptr<Data> build(const SceneDescription& description, const BuildOptions& options, Clock::time_point begin) {
    auto data = std::make_unique<Data>();
    data->kernels = &find_kernels(options.isa, precision_named(options.precision));
    RenderSettings settings = description.render;
    settings.bvh = bvh_of(options.bvh);
    data->arrays = flatten(description, settings, options.threads > 0 ? options.threads : default_thread_count());
    data->scene = view(data->arrays);
    const Normalisation& normalisation = data->arrays.normalisation;
    for (int axis = 0; axis < 3; ++axis) data->units.centre[axis] = normalisation.centre[axis];
    data->units.scale = normalisation.scale;
    data->objects = number_objects(description);
    data->build_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    return data;
}

/// Calls `trace` with pieces of at most 2^31 rays: a stream counts in 32 bits.
template <class Trace>
void for_each_piece(const RayArrays& rays, const StreamUnits& units, Trace&& trace) {
    constexpr std::size_t longest = std::size_t{1} << 31;
    for (std::size_t begin = 0; begin < rays.count; begin += longest) {
        RayStream stream{};
        const std::size_t first_org = rays.common_origin ? 0 : begin;
        stream.org[0] = rays.org_x + first_org;
        stream.org[1] = rays.org_y + first_org;
        stream.org[2] = rays.org_z + first_org;
        stream.dir[0] = rays.dir_x + begin;
        stream.dir[1] = rays.dir_y + begin;
        stream.dir[2] = rays.dir_z + begin;
        stream.tmin = rays.tmin != nullptr ? rays.tmin + begin : nullptr;
        stream.tmax = rays.tmax != nullptr ? rays.tmax + begin : nullptr;
        stream.count = static_cast<std::uint32_t>(std::min(rays.count - begin, longest));
        stream.common_origin = rays.common_origin ? 1 : 0;
        stream.coherent = rays.coherence == Coherence::coherent ? 1 : 0;
        stream.units = &units;
        trace(stream, begin);
    }
}

template <class T>
T* moved(T* p, std::size_t begin) {
    return p != nullptr ? p + begin : nullptr;
}

/// No two scenes of a process share one.
std::uint64_t next_scene_id() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// What hid a light from the rays of one call is likely to hide it from those of the next, too: each thread keeps it, for the
/// scene that it asked last. Measured: docs/performance.md.
struct KeptOccluders {
    std::uint64_t scene_id = 0;
    Occluders occluders{};
};
thread_local constinit KeptOccluders kept_occluders;

Occluders& occluders_of(std::uint64_t scene_id) {
    if (kept_occluders.scene_id != scene_id) kept_occluders = {scene_id, {}};
    return kept_occluders.occluders;
}

} // namespace

struct Scene::Data {
    const std::uint64_t id = next_scene_id();
    SceneArrays arrays;
    SceneView scene{};
    StreamUnits units{};
    std::vector<StreamObject> objects;
    const KernelTable* kernels = nullptr;
    double build_seconds = 0;
};

Scene::Scene(std::span<const MeshArrays> meshes, const BuildOptions& options) {
    const auto begin = Clock::now();
    data_ = build<Data>(describe(meshes), options, begin);
}
Scene::Scene(const MeshArrays& mesh, const BuildOptions& options) : Scene(std::span(&mesh, 1), options) {}
Scene::Scene(const std::filesystem::path& file, const BuildOptions& options) {
    const auto begin = Clock::now();
    data_ = build<Data>(describe(file), options, begin);
}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

void Scene::closest_hit(const RayArrays& rays, const HitArrays& hits) const noexcept {
    for_each_piece(rays, data_->units, [&](RayStream& stream, std::size_t begin) {
        stream.t = moved(hits.t, begin);
        stream.objects = data_->objects.empty() ? nullptr : data_->objects.data();
        stream.object = moved(hits.object, begin);
        stream.primitive = moved(hits.primitive, begin);
        stream.normal[0] = moved(hits.normal_x, begin);
        stream.normal[1] = moved(hits.normal_y, begin);
        stream.normal[2] = moved(hits.normal_z, begin);
        stream.u = moved(hits.u, begin);
        stream.v = moved(hits.v, begin);
        data_->kernels->closest_hit(data_->scene, stream);
    });
}

void Scene::any_hit(const RayArrays& rays, std::uint8_t* occluded) const noexcept {
    for_each_piece(rays, data_->units, [&](RayStream& stream, std::size_t begin) {
        stream.occluded = occluded + begin;
        stream.occluders = &occluders_of(data_->id);
        data_->kernels->any_hit(data_->scene, stream);
    });
}

SceneFacts Scene::facts() const {
    const SceneArrays& arrays = data_->arrays;
    SceneFacts facts;
    facts.triangles = arrays.triangles.size();
    facts.primitives = arrays.scene_id.size();
    facts.bytes = memory_bytes(arrays) + data_->objects.capacity() * sizeof(StreamObject);
    for (int axis = 0; axis < 3; ++axis) {
        facts.bounds_min[axis] = static_cast<float>(arrays.bounds_min[axis]);
        facts.bounds_max[axis] = static_cast<float>(arrays.bounds_max[axis]);
    }
    facts.isa = data_->kernels->isa;
    facts.build_seconds = data_->build_seconds;
    return facts;
}

} // namespace lanecast
