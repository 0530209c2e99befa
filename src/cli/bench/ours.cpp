// Lanecast through its public interface: what is timed is the whole call, conversion included.

#include "cli/bench/contender.hpp"

#include <limits>

namespace lanecast::bench {
namespace {

class Ours final : public Contender {
public:
    explicit Ours(Scene scene) : scene_(std::move(scene)) { ours = true; }

    void prepare(const RaySet& set) override {
        set_ = &set;
        t_.assign(set.size(), 0);
        primitive_.assign(set.query == Query::closest ? set.size() : 0, 0);
        occluded_.assign(set.query == Query::any ? set.size() : 0, 0);
        tmax_.assign(set.tmax < std::numeric_limits<float>::infinity() ? set.size() : 0, set.tmax);
    }

    void reset(std::size_t chunk) override {
        const std::size_t begin = chunk * chunk_rays, bytes = set_->chunk_size(chunk) * sizeof(float);
        for (int axis = 0; axis < 3; ++axis) {
            if (!set_->common_origin) warm(&set_->org[axis][begin], bytes);
            warm(&set_->dir[axis][begin], bytes);
        }
        if (!tmax_.empty()) warm(&tmax_[begin], bytes);
        if (set_->query == Query::any) {
            warm(&occluded_[begin], set_->chunk_size(chunk));
        } else {
            warm(&t_[begin], bytes);
            warm(&primitive_[begin], bytes);
        }
    }

    void trace(std::size_t chunk) override {
        const std::size_t begin = chunk * chunk_rays, first_org = set_->common_origin ? 0 : begin;
        RayArrays rays;
        rays.org_x = set_->org[0].data() + first_org;
        rays.org_y = set_->org[1].data() + first_org;
        rays.org_z = set_->org[2].data() + first_org;
        rays.dir_x = set_->dir[0].data() + begin;
        rays.dir_y = set_->dir[1].data() + begin;
        rays.dir_z = set_->dir[2].data() + begin;
        rays.tmax = tmax_.empty() ? nullptr : tmax_.data() + begin;
        rays.count = set_->chunk_size(chunk);
        rays.common_origin = set_->common_origin;
        rays.coherence = set_->coherence;
        if (set_->query == Query::any) {
            scene_.any_hit(rays, occluded_.data() + begin);
            return;
        }
        HitArrays hits;
        hits.t = t_.data() + begin;
        hits.primitive = primitive_.data() + begin;
        scene_.closest_hit(rays, hits);
    }

    [[nodiscard]] HitList hits() const override {
        if (set_->query == Query::closest) return {t_, primitive_};
        HitList list{t_, {}};
        for (std::size_t i = 0; i < list.t.size(); ++i)
            list.t[i] = occluded_[i] != 0 ? 0.0f : std::numeric_limits<float>::infinity();
        return list;
    }

private:
    Scene scene_;
    const RaySet* set_ = nullptr;
    std::vector<float> t_, tmax_;
    std::vector<std::uint32_t> primitive_;
    std::vector<std::uint8_t> occluded_;
};

} // namespace

void add_ours(Contenders& contenders, std::vector<BuildRow>& builds, const BenchMesh& mesh, const std::string& isa,
              const std::string& precision, const std::string& bvh, int threads) {
    Scene scene(mesh.arrays(), {.threads = threads, .isa = isa, .bvh = bvh, .precision = precision});
    const SceneFacts facts = scene.facts();
    auto contender = std::make_unique<Ours>(std::move(scene));
    contender->library = "lanecast " LANECAST_VERSION;
    contender->isa = facts.isa;
    contender->precision = precision;
    contender->mode = bvh;
    builds.push_back({contender->library, facts.isa, bvh, facts.build_seconds, static_cast<double>(facts.bytes)});
    contenders.push_back(std::move(contender));
}

} // namespace lanecast::bench
