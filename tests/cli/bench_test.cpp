// What bench measures with: its meshes, its rays, and that hits which are wrong are found.

#include "cli/bench/agreement.hpp"
#include "cli/bench/measure.hpp"
#include "cli/bench/ray_sets.hpp"
#include "cli/bench/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::bench;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

glm::dvec3 at(const std::vector<float> (&v)[3], std::size_t i) { return {v[0][i], v[1][i], v[2][i]}; }

/// Two steps, one before the other.
BenchMesh small_mesh() {
    BenchMesh mesh;
    mesh.name = "steps";
    mesh.positions = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 1, 0, -1, 1, 0, 1, 1, -1, 1, 1};
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    mesh.lo = {-1, -1, 0};
    mesh.hi = {1, 1, 1};
    view_from_outside(mesh, false);
    mesh.view.position = {0.2, 0.1, 5};
    mesh.view.look_at = {0.1, 0, 0};
    mesh.view.light = {2, 2, 3};
    return mesh;
}

/// Answers what it was given, and waits as long as it was told.
class Fake final : public Contender {
public:
    explicit Fake(std::uint64_t ticks_per_ray) : ticks_(ticks_per_ray) {}
    void prepare(const RaySet& set) override { set_ = &set; }
    void reset(std::size_t) override {}
    void trace(std::size_t chunk) override {
        const std::uint64_t end = __builtin_ia32_rdtsc() + ticks_ * set_->chunk_size(chunk);
        while (__builtin_ia32_rdtsc() < end) {
        }
    }
    [[nodiscard]] HitList hits() const override { return {std::vector<float>(set_->size(), infinity), {}}; }

private:
    std::uint64_t ticks_;
    const RaySet* set_ = nullptr;
};

TEST_CASE("a terrain of any size") {
    for (const std::size_t triangles : {2, 1000, 10000, 100000}) {
        const BenchMesh mesh = make_mesh("terrain", triangles);
        CHECK(static_cast<double>(mesh.triangles()) == doctest::Approx(static_cast<double>(triangles)).epsilon(0.04));
        CHECK(mesh.lo.x == -2);
        CHECK(mesh.hi.x == 2);
        CHECK(mesh.hi.y < 1.5);
    }
}

TEST_CASE("procedural meshes: about as many triangles as promised, and hardly any degenerate") {
    const struct {
        const char* name;
        std::size_t least, most;
    } promised[] = {{"flake", 1000000, 1100000}, {"terrain", 1000000, 1100000}, {"hall", 450000, 550000}};
    for (const auto& [name, least, most] : promised) {
        CAPTURE(name);
        const BenchMesh mesh = make_mesh(name);
        CHECK(mesh.triangles() >= least);
        CHECK(mesh.triangles() <= most);
        CHECK(*std::max_element(mesh.indices.begin(), mesh.indices.end()) < mesh.positions.size() / 3);
        CHECK(Scene(mesh.arrays()).facts().triangles == mesh.triangles());
        bool inside = true;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const auto axis = static_cast<int>(i % 3);
            inside = inside && mesh.positions[i] >= mesh.lo[axis] - 1e-5 && mesh.positions[i] <= mesh.hi[axis] + 1e-5;
        }
        CHECK(inside);
    }
}

TEST_CASE("ray sets: of every kind, starting where they should") {
    const BenchMesh mesh = small_mesh();
    const Scene scene(mesh.arrays());
    const std::vector<RaySet> sets = make_ray_sets(mesh, scene, ray_kinds(), 65536);
    REQUIRE(sets.size() == ray_kinds().size());
    const auto& [primary, aa, shadow, light, sun, mirror, diffuse] =
        std::tie(sets[0], sets[1], sets[2], sets[3], sets[4], sets[5], sets[6]);
    CHECK(primary.size() == 65536);
    CHECK(primary.chunks() == 64);
    CHECK(aa.size() == 65536);
    CHECK(shadow.size() > 1000);
    CHECK(light.size() == shadow.size());
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        CHECK(glm::distance(at(shadow.org, i) + at(shadow.dir, i), mesh.view.light) < 1e-5);
        CHECK(glm::distance(at(light.org, i) + at(light.dir, i), at(shadow.org, i)) < 1e-5);
    }
    for (const RaySet* set : {&mirror, &diffuse, &sun}) // on one of the steps, and away from it
        for (std::size_t i = 0; i < set->size(); ++i) {
            const double z = set->org[2][i];
            CHECK(std::min(std::abs(z), std::abs(z - 1)) < 1e-4);
            CHECK(set->dir[2][i] > 0);
            CHECK(glm::length(at(set->dir, i)) == doctest::Approx(1));
        }
    double cosine = 0; // the mean of a cosine distribution is 2/3
    for (const float z : diffuse.dir[2]) cosine += static_cast<double>(z) / static_cast<double>(diffuse.size());
    CHECK(cosine == doctest::Approx(2.0 / 3).epsilon(0.02));
}

TEST_CASE("pixels of a picture are spread, each in one place") {
    const BenchMesh mesh = small_mesh();
    const Scene scene(mesh.arrays());
    const RaySet all = make_ray_sets(mesh, scene, {"primary"}, 10000000)[0];
    CHECK(all.size() == 1920 / 32 * (1080 / 32) * 1024);
    std::set<std::pair<float, float>> directions;
    for (std::size_t i = 0; i < 4096; ++i) directions.insert({all.dir[0][i], all.dir[1][i]});
    CHECK(directions.size() == 4096);
}

TEST_CASE("wrong hits are found, those at edges are told apart") {
    const BenchMesh mesh = small_mesh();
    const Scene scene(mesh.arrays()), reference(mesh.arrays(), {.precision = "reference"});
    const RaySet primary = make_ray_sets(mesh, scene, {"primary"}, 16384)[0];
    const Truth truth = find_truth(primary, reference, mesh, primary.size());
    HitList hits = truth.hits;
    CHECK(compare_to_truth(hits, truth).count() == 0);
    CHECK(compare_to_peer(hits, hits, truth).count() == 0);
    std::size_t hit = 0, miss = 0;
    while (std::isinf(hits.t[hit])) ++hit;
    while (!std::isinf(hits.t[miss])) ++miss;
    hits.t[hit] *= 1.01f;
    hits.t[miss] = 3;
    Disagreements found = compare_to_truth(hits, truth);
    CHECK(found.other_t == 1);
    CHECK(found.extra == 1);
    CHECK(found.edges == 0);
    hits.t[hit] = infinity;
    found = compare_to_truth(hits, truth);
    CHECK(found.missed == 1);
    CHECK(found.edges == 0);
    found = compare_to_peer(truth.hits, hits, truth);
    CHECK(found.count() == 2);
    CHECK(found.upheld == 2);
    hits = truth.hits;
    hits.primitive[hit] ^= 1u;
    found = compare_to_truth(hits, truth);
    CHECK(found.ties == 1);
    CHECK(found.count() == 0);

    RaySet edge = primary; // exactly at the edge of the nearer step, x = 0: which step is hit is a matter of rounding
    for (int axis = 0; axis < 3; ++axis) edge.org[axis] = {axis == 2 ? 5.0f : 0.0f}, edge.dir[axis] = {axis == 2 ? -1.0f : 0.0f};
    const Truth at_edge = find_truth(edge, reference, mesh, 1);
    found = compare_to_truth({{at_edge.hits.t[0] == 4 ? 5.0f : 4.0f}, {0}}, at_edge);
    CHECK(found.count() == 1);
    CHECK(found.edges == 1);
}

TEST_CASE("rates are those of the contenders, whoever else runs") {
    const BenchMesh mesh = small_mesh();
    const Scene scene(mesh.arrays());
    const RaySet set = make_ray_sets(mesh, scene, {"primary"}, 16384)[0];
    Contenders contenders;
    contenders.push_back(std::make_unique<Fake>(40));
    contenders.push_back(std::make_unique<Fake>(120));
    const Measured measured = measure(contenders, set, 5, 1);
    // Bounds that hold however busy the machine is: nobody is faster than he waits, and the order is his own.
    CHECK(measured.rates[0].rays_per_second <= ticks_per_second() / 40 * 1.05);
    CHECK(measured.rates[1].rays_per_second <= ticks_per_second() / 120 * 1.05);
    CHECK(measured.rates[0].rays_per_second > measured.rates[1].rays_per_second);
    CHECK(measured.hits[0].t.size() == set.size());

    Report report;
    for (const auto& [mode, ours, rate] : {std::tuple{"stream", true, 30.0}, {"slow", false, 10.0}, {"fast", false, 20.0}}) {
        Row row;
        row.rays = "primary";
        row.mode = mode;
        row.ours = ours;
        row.rate.rays_per_second = rate;
        report.rows.push_back(row);
    }
    REQUIRE(best_peer(report, report.rows[0]) != nullptr);
    CHECK(best_peer(report, report.rows[0])->mode == "fast");
    CHECK(json_report(report).find("\"ratio\": 1.5") != std::string::npos);
    const Drawing drawing = plot(report);
    CHECK(svg_of(drawing).starts_with("<svg"));
    const Picture8 picture = picture_of(drawing);
    CHECK(picture.rgb.size() == 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    CHECK(std::count(picture.rgb.begin(), picture.rgb.end(), 255) < static_cast<std::ptrdiff_t>(picture.rgb.size()) - 1000);
}

} // namespace
