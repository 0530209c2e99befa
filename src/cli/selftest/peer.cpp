#include "cli/selftest/peer.hpp"

#include "cli/embree_module.hpp"
#include "scene/error.hpp"

#include <algorithm>

namespace lanecast::selftest {
namespace {

decltype(lanecast_ask_embree)* ask_embree = nullptr;
std::string embree_isa;

/// Of normalised coordinates, as `units` has it.
struct ToCaller {
    double centre[3] = {0, 0, 0}, scale = 1;
    explicit ToCaller(const StreamUnits* units) {
        if (units == nullptr) return;
        std::copy(std::begin(units->centre), std::end(units->centre), centre);
        scale = units->scale;
    }
    [[nodiscard]] float length(float x) const { return static_cast<float>(double{x} / scale); }
    [[nodiscard]] float place(float x, int axis) const { return static_cast<float>(double{x} / scale + centre[axis]); }
};

PeerScene scene_for_peer(const SceneView& scene, const StreamUnits* units) {
    const ToCaller world(units);
    PeerScene peer;
    for (std::uint32_t slot = 0; slot < scene.first_slot[1]; ++slot) {
        const std::uint32_t block = scene.triangles[slot].block, n = (block >> 3 & 7u) + 1;
        const auto* const rows = reinterpret_cast<const float*>(scene.arena + std::size_t{block >> 6} * 64) + (block & 7u);
        for (std::uint32_t row = 0; row < 9; ++row) peer.corners.push_back(world.place(rows[row * n], int(row % 3)));
    }
    peer.first_sphere = static_cast<std::int32_t>(scene.first_slot[1]);
    for (std::uint32_t i = 0; i < scene.first_slot[2] - scene.first_slot[1]; ++i) {
        SphereRecord sphere = scene.spheres[i];
        for (int axis = 0; axis < 3; ++axis) sphere.centre[axis] = world.place(sphere.centre[axis], axis);
        sphere.radius = world.length(sphere.radius);
        peer.spheres.push_back(sphere);
    }
    for (std::uint32_t slot = scene.first_slot[2]; slot < scene.first_slot[5]; ++slot) { // ellipsoids, cylinders, cones
        const AffineRecord& record = scene.affines[slot - scene.first_slot[2]];
        const AffineShadingRecord& forward = scene.affine_shading[slot - scene.first_slot[2]];
        const bool ellipsoid = slot < scene.first_slot[3], cylinder = slot < scene.first_slot[4];
        PeerScene::Body body{static_cast<std::int32_t>(slot),
                             ellipsoid  ? PrimitiveKind::ellipsoid
                             : cylinder ? PrimitiveKind::cylinder
                                        : PrimitiveKind::cone,
                             ellipsoid || cylinder ? 0 : record.taper,
                             {},
                             {}};
        for (int i = 0; i < 9; ++i) body.world_from_object[i] = world.length(forward.world_from_object[i]);
        for (int axis = 0; axis < 3; ++axis) body.translation[axis] = world.place(record.translation[axis], axis);
        peer.bodies.push_back(body);
    }
    return peer;
}

template <bool robust, Query query>
void ask_peer(const SceneView& scene, const RayStream& rays) noexcept {
    ask_embree(scene_for_peer(scene, rays.units), rays, {embree_isa.c_str(), robust, query});
}

template <bool robust>
const KernelTable& embree_kernels(const char* name, std::int32_t width) {
    static KernelTable table{};
    table.isa = name, table.width = width, table.precision = Precision::balanced;
    table.closest_hit = ask_peer<robust, Query::closest>;
    table.any_hit = ask_peer<robust, Query::any>;
    return table;
}

} // namespace

std::vector<Contender> embree_contenders(const std::string& isa) {
    auto* const open = find_in_embree_module<decltype(lanecast_open_embree)>("lanecast_open_embree");
    ask_embree = find_in_embree_module<decltype(lanecast_ask_embree)>("lanecast_ask_embree");
    if (open == nullptr || ask_embree == nullptr)
        throw Error(ExitCode::isa, "--peer: this build has no Embree; see docs/building.md");
    const std::string name = std::string("Embree ") + open(isa.c_str());
    embree_isa = isa;
    const std::int32_t width = isa == "avx512" ? 16 : isa == "avx2" ? 8 : 4;
    return {{name + " default", &embree_kernels<false>("Embree, default,", width)},
            {name + " robust", &embree_kernels<true>("Embree, robust,", width)}};
}

} // namespace lanecast::selftest
