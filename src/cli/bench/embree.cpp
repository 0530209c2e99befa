// Embree as the peer: its own ray layouts, filled beforehand and reset before each chunk, both untimed; its trace calls are
// timed.

#include "cli/bench/contender.hpp"
#include "cli/bench/embree_scene.hpp"

#include <chrono>
#include <limits>
#include <new>

namespace lanecast::bench {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The tree of one instruction set and quality.
struct Tree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

/// A set's rays as packets.
template <class T>
class PacketArray {
public:
    void resize(std::size_t count) {
        if (count == size_) return;
        packets_.reset(static_cast<T*>(::operator new[](count * sizeof(T), std::align_val_t{64})));
        size_ = count;
        std::memset(static_cast<void*>(packets_.get()), 0, count * sizeof(T));
    }
    [[nodiscard]] T& operator[](std::size_t i) { return packets_.get()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return packets_.get()[i]; }

private:
    struct Delete {
        void operator()(T* p) const { ::operator delete[](static_cast<void*>(p), std::align_val_t{64}); }
    };
    std::unique_ptr<T, Delete> packets_;
    std::size_t size_ = 0;
};

/// The contenders of one width trace in turn, so they share their rays.
template <int width>
struct SharedRays {
    const RaySet* set = nullptr;
    PacketArray<typename Packet<width>::RayHits> closest;
    PacketArray<typename Packet<width>::Rays> any;
};

template <int width>
class Embree final : public Contender {
public:
    Embree(std::shared_ptr<Tree> tree, std::shared_ptr<SharedRays<width>> rays, bool coherent)
        : tree_(std::move(tree)), rays_(std::move(rays)), coherent_(coherent) {}

    void prepare(const RaySet& set) override {
        set_ = &set;
        const std::size_t packets = (set.size() + width - 1) / width;
        if (rays_->set == &set) return;
        rays_->set = &set;
        set.query == Query::any ? rays_->any.resize(packets) : rays_->closest.resize(packets);
        for (std::size_t i = 0; i < packets * width; ++i)
            with_ray(i / width, [&](auto& ray) { fill(ray, i % width, std::min(i, set.size() - 1)); });
    }

    void reset(std::size_t chunk) override {
        const std::size_t begin = chunk * chunk_rays, end = begin + set_->chunk_size(chunk);
        for (std::size_t i = begin; i < end; ++i) {
            with_ray(i / width, [&](auto& ray) { lane_of(ray.tfar, i % width) = set_->tmax; });
            if (set_->query == Query::closest) lane_of(rays_->closest[i / width].hit.geomID, i % width) = RTC_INVALID_GEOMETRY_ID;
        }
        const std::size_t first = begin / width, packets = (end + width - 1) / width - first;
        if (set_->query == Query::closest)
            warm(&rays_->closest[first], packets * sizeof(rays_->closest[first]));
        else
            warm(&rays_->any[first], packets * sizeof(rays_->any[first]));
    }

    void trace(std::size_t chunk) override {
        Asking query(coherent_);
        const std::size_t begin = chunk * chunk_rays, end = begin + set_->chunk_size(chunk);
        if (set_->query == Query::closest)
            trace_packets(query, rays_->closest, begin, end);
        else
            trace_packets(query, rays_->any, begin, end);
    }

    [[nodiscard]] HitList hits() const override {
        HitList list;
        list.t.resize(set_->size());
        if (set_->query == Query::closest) list.primitive.resize(set_->size());
        for (std::size_t i = 0; i < set_->size(); ++i) {
            if (set_->query == Query::any) {
                list.t[i] = lane_of(rays_->any[i / width].tfar, i % width) < 0 ? 0 : infinity;
                continue;
            }
            auto& packet = rays_->closest[i / width];
            const bool found = lane_of(packet.hit.geomID, i % width) != RTC_INVALID_GEOMETRY_ID;
            list.t[i] = found ? lane_of(packet.ray.tfar, i % width) : infinity;
            list.primitive[i] = found ? lane_of(packet.hit.primID, i % width) : no_hit;
        }
        return list;
    }

private:
    template <class Visit>
    void with_ray(std::size_t packet, Visit&& visit) {
        if (set_->query == Query::any)
            visit(rays_->any[packet]);
        else
            visit(rays_->closest[packet].ray);
    }

    template <class Ray>
    void fill(Ray& ray, std::size_t lane, std::size_t i) {
        lane_of(ray.org_x, lane) = set_->org[0][i];
        lane_of(ray.org_y, lane) = set_->org[1][i];
        lane_of(ray.org_z, lane) = set_->org[2][i];
        lane_of(ray.dir_x, lane) = set_->dir[0][i];
        lane_of(ray.dir_y, lane) = set_->dir[1][i];
        lane_of(ray.dir_z, lane) = set_->dir[2][i];
        lane_of(ray.mask, lane) = ~0u;
    }

    template <class Array>
    void trace_packets(Asking& query, Array& array, std::size_t begin, std::size_t end) {
        alignas(64) int valid[width];
        std::memset(valid, 0xff, sizeof valid);
        std::size_t i = begin;
        for (; i + width <= end; i += width) trace_packet<width>(tree_->scene, query, array[i / width], valid);
        if (i == end) return;
        for (std::size_t lane = end - i; lane < width; ++lane) valid[lane] = 0;
        trace_packet<width>(tree_->scene, query, array[i / width], valid);
    }

    std::shared_ptr<Tree> tree_;
    std::shared_ptr<SharedRays<width>> rays_;
    bool coherent_;
    const RaySet* set_ = nullptr;
};

std::shared_ptr<Tree> build_tree(const BenchMesh& mesh, const std::string& isa, bool high, int threads, BuildRow& row) {
    const auto begin = std::chrono::steady_clock::now();
    const auto tree = std::make_shared<Tree>();
    static double bytes = 0; // one tree at a time
    bytes = 0;
    tree->device = make_device(isa, threads, bytes);
    tree->scene = make_scene(tree->device, mesh, high);
    rtcCommitScene(tree->scene);
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    row.bytes = bytes;
    rtcSetDeviceMemoryMonitorFunction(tree->device, nullptr, nullptr);
    return tree;
}

template <int width>
void add_modes(Contenders& contenders, const std::shared_ptr<Tree>& tree, const std::string& isa, const std::string& quality) {
    static const auto rays = std::make_shared<SharedRays<width>>();
    for (const bool coherent : {false, true}) {
        if (width == 1 && coherent) continue;
        auto contender = std::make_unique<Embree<width>>(tree, rays, coherent);
        contender->library = "embree " RTC_VERSION_STRING;
        contender->isa = isa;
        contender->precision = "-";
        contender->mode = quality + ":" + std::to_string(width) + (coherent ? "c" : "");
        contenders.push_back(std::move(contender));
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) void lanecast_add_embree(Contenders& contenders, std::vector<BuildRow>& builds,
                                                                           const BenchMesh& mesh, const std::string& isa,
                                                                           int threads) {
    if (isa == "scalar") return;
    for (const bool high : {false, true}) {
        const std::string quality = high ? "high" : "medium";
        BuildRow row{"embree " RTC_VERSION_STRING, isa, quality};
        const auto tree = build_tree(mesh, isa, high, threads, row);
        builds.push_back(row);
        add_modes<1>(contenders, tree, isa, quality);
        if (isa == "sse4.2") add_modes<4>(contenders, tree, isa, quality);
        if (isa == "avx2") add_modes<8>(contenders, tree, isa, quality);
        if (isa == "avx512") add_modes<16>(contenders, tree, isa, quality);
    }
}

} // namespace lanecast::bench
