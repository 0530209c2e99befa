// What `measure` measures with: knobs, errors, the walk, the front, and that wrong hits are found.
#include "cli/measure/experiment.hpp"
#include "cli/measure/sampling.hpp"

#include "render/dispatch.hpp"
#include "render/render_support.hpp"
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace lanecast;
using namespace lanecast::trade;

namespace {

/// A scene with every knob, or with none but those that every scene has.
struct Stage {
    SceneDescription scene;
    SceneArrays arrays;
    Bench bench;

    explicit Stage(bool plain = false) {
        if (!plain) scene = test::everything();
        if (plain) scene.objects.push_back({Sphere{}, {}, Material{}, ""});
        for (Light& light : scene.lights)
            if (auto* point = std::get_if<PointLight>(&light)) point->radius = 0.3;
        RenderSettings settings = scene.render;
        settings.soft_shadows = 1;
        arrays = flatten(scene, settings, 2);
        bench.scene = &arrays;
        bench.camera = &scene.camera;
        bench.options.width = 24;
        bench.options.height = 18;
        bench.options.threads = 2;
        bench.sample = every_tile(bench.options);
    }
    [[nodiscard]] Choice base() const {
        Choice choice{scene.render, false};
        choice.settings.soft_shadows = 2;
        return choice;
    }
};

std::set<Knob> knobs_of(const std::vector<Ladder>& ladders) {
    std::set<Knob> knobs;
    for (const Ladder& ladder : ladders) knobs.insert(ladder.knob);
    return knobs;
}

KernelTable broken;
int breakage = 0;

/// Every 100th ray is wrong, in one of the ways.
void broken_hit(const SceneView& scene, const RayStream& rays) noexcept {
    find_kernels("auto", Precision::reference).closest_hit(scene, rays);
    for (std::uint32_t i = 0; i < rays.count; i += 100) {
        if (breakage == 0 && rays.slot[i] >= 0) rays.slot[i] = -1;
        if (breakage == 1 && rays.slot[i] < 0) rays.slot[i] = 0, rays.t[i] = 1;
        if (breakage == 2 && rays.slot[i] >= 0) rays.slot[i] ^= 1, rays.t[i] *= 1.5f;
        if (breakage == 3 && rays.slot[i] >= 0) rays.slot[i] ^= 1; // a tie
        if (breakage == 4 && rays.slot[i] >= 0) rays.t[i] = std::nextafter(std::nextafter(rays.t[i], 1e30f), 1e30f);
        if (breakage == 5 && rays.slot[i] >= 0) rays.normal[0][i] += 0.01f;
    }
}

} // namespace

TEST_CASE("knobs that the command line sets are told from those it leaves alone") {
    const FixedKnobs none = fixed_knobs([](RenderSettings s) { return s; });
    for (const bool fixed : none.fixed) CHECK(!fixed);
    const FixedKnobs some = fixed_knobs([](RenderSettings s) {
        s.anti_aliasing.mode = AntiAliasMode::off;
        s.depth = 3;
        return s;
    });
    CHECK(some[Knob::anti_aliasing]);
    CHECK(some[Knob::depth]);
    CHECK(!some[Knob::precision]);
    CHECK(!some[Knob::soft_shadows]);
    CHECK(!some[Knob::cutoff]);
    CHECK(fixed_knobs([](RenderSettings s) { return s.precision = Precision::reference, s; })[Knob::precision]);
    CHECK(fixed_knobs([](RenderSettings s) { return s.cutoff = 0, s; })[Knob::cutoff]);
}

TEST_CASE("a scene has the knobs that change its picture, each value once, its own among them, the truth beyond all") {
    const Stage full, plain(true);
    CHECK(knobs_of(make_ladders(plain.arrays, {}, {}, "auto", 16)) == std::set{Knob::precision, Knob::anti_aliasing, Knob::file});
    Choice base = full.base();
    base.settings.anti_aliasing = {AntiAliasMode::grid, 5, 1.0 / 3, true};
    base.settings.soft_shadows = 7;
    base.settings.depth = 5;
    base.settings.cutoff = 0.01;
    const std::vector<Ladder> ladders = make_ladders(full.arrays, base, {}, "auto", 16);
    CHECK(ladders.size() == knob_count);
    CHECK(knobs_of(ladders).size() == knob_count);
    for (const Ladder& ladder : ladders) {
        CAPTURE(name_of(ladder.knob));
        std::set<std::string> labels;
        for (const KnobValue& value : ladder.values) {
            labels.insert(value.label);
            Choice choice;
            value.set(choice);
            CHECK(label_of(ladder.knob, choice) == value.label);
        }
        CHECK(labels.size() == ladder.values.size());
        CHECK(labels.count(label_of(ladder.knob, base)) == 1);
        if (ladder.knob != Knob::file) CHECK(labels.count(ladder.alone.label) == 0);
    }
    const Choice truth = true_choice(base, ladders);
    CHECK(truth.settings.precision == Precision::reference);
    CHECK(truth.settings.anti_aliasing.samples == 16);
    CHECK(truth.settings.depth >= 64);
    CHECK(truth.float_file);
    FixedKnobs fixed;
    fixed[Knob::anti_aliasing] = true;
    const std::vector<Ladder> without = make_ladders(full.arrays, base, fixed, "auto", 16);
    CHECK(knobs_of(without).count(Knob::anti_aliasing) == 0);
    CHECK(true_choice(base, without).settings.anti_aliasing.samples == 5);
    CHECK(true_choice(base, without).settings.soft_shadows == 256);
    base.settings.anti_aliasing.mode = AntiAliasMode::off; // no other samples of the pixel share the work
    CHECK(true_choice(base, make_ladders(full.arrays, base, fixed, "auto", 16)).settings.soft_shadows == 1024);
}

TEST_CASE("downhill, one knob at a time, everything is reached and nothing comes back") {
    const Stage stage;
    const std::vector<Ladder> ladders = make_ladders(stage.arrays, stage.base(), {}, "auto", 16);
    for (const Ladder& ladder : ladders) {
        if (ladder.knob == Knob::precision) continue;
        std::set<std::string> met;
        std::vector<Choice> open{dearest_choice(stage.base(), ladders)};
        for (std::size_t steps = 0; !open.empty() && steps < 10000; ++steps) {
            const Choice choice = open.back();
            open.pop_back();
            met.insert(label_of(ladder.knob, choice));
            for (const Choice& next : cheaper(choice, ladder)) {
                CHECK(label_of(ladder.knob, next) != label_of(ladder.knob, choice));
                open.push_back(next);
            }
        }
        CHECK(open.empty());
        CHECK(met.count(ladder.values.front().label) == 1);
    }
}

TEST_CASE("from the truth every knob goes down: no choice is deeper or cuts off less, whatever the scene's own values") {
    for (const double cutoff : {0.0, 0.001, 1.0}) {
        const Stage stage;
        Choice base = stage.base();
        base.settings.cutoff = cutoff;
        const std::vector<Ladder> ladders = make_ladders(stage.arrays, base, {}, "auto", 16);
        const Choice truth = true_choice(base, ladders);
        for (const Ladder& ladder : ladders) {
            CAPTURE(name_of(ladder.knob));
            const std::vector<Choice> lower = cheaper(truth, ladder);
            CHECK(!lower.empty());
            for (const Choice& choice : lower) {
                CHECK(label_of(ladder.knob, choice) != label_of(ladder.knob, truth));
                CHECK(choice.settings.depth <= truth.settings.depth);
                CHECK(choice.settings.cutoff >= truth.settings.cutoff);
                CHECK(choice.settings.soft_shadows <= truth.settings.soft_shadows);
            }
        }
    }
}

TEST_CASE("the front: nothing beats its members, and something beats all others") {
    std::mt19937 random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> seconds, errors;
        for (std::size_t n = 1 + random() % 20, i = 0; i < n; ++i) {
            seconds.push_back(static_cast<double>(random() % 10));
            errors.push_back(static_cast<double>(random() % 10));
        }
        const std::vector<std::size_t> front = front_of(seconds, errors);
        REQUIRE(!front.empty());
        const std::set<std::size_t> members(front.begin(), front.end());
        for (std::size_t i = 0; i < seconds.size(); ++i) {
            bool beaten = false;
            for (std::size_t k = 0; k < seconds.size(); ++k)
                beaten = beaten || (seconds[k] <= seconds[i] && errors[k] <= errors[i] &&
                                    (seconds[k] < seconds[i] || errors[k] < errors[i]));
            if (members.count(i) == 1) REQUIRE(!beaten);
            bool covered = beaten;
            for (const std::size_t m : front) covered = covered || (seconds[m] == seconds[i] && errors[m] == errors[i]);
            REQUIRE(covered);
        }
        for (std::size_t i = 1; i < front.size(); ++i) REQUIRE(seconds[front[i - 1]] < seconds[front[i]]);
    }
}

TEST_CASE("errors: none of the same picture, known ones found, over all windows") {
    Stage stage;
    FrameOptions options;
    options.width = options.height = 128;
    for (const bool whole : {true, false}) {
        const TileSample sample = whole ? every_tile(options) : spread_tiles(options, 4);
        ReferencePicture reference;
        for (const Tile& window : sample.windows) {
            reference.films.push_back(make_film(128, 128, window));
            for (auto& plane : reference.films.back().rgb) std::fill(plane.begin(), plane.end(), 0.5f);
            reference.seen.push_back(see(reference.films.back()));
        }
        std::vector<Film> films = reference.films;
        PictureError error = error_of(films, reference, sample);
        CHECK(error.rmse == 0);
        CHECK(error.relmse == 0);
        CHECK(error.largest == 0);
        CHECK(error.off == 0);
        CHECK(error.flip == 0);
        CHECK(error.rmse_above == 0);
        films[0].rgb[1][17] = 0.75f;
        error = error_of(films, reference, sample);
        CHECK(error.rmse == doctest::Approx(0.25 / std::sqrt(3 * sample.pixels())));
        CHECK(error.relmse == doctest::Approx(0.0625 / 0.26 / (3 * sample.pixels())));
        CHECK(error.largest == 0.25);
        CHECK(error.off == doctest::Approx(1 / sample.pixels()));
        CHECK(error.flip > 0);
        // one tile of four is bad: the frame may be worse than the sample
        CHECK((error.rmse_above > error.rmse) == !whole);
        if (whole) continue;
        TileSample certain = sample; // it stands for itself, the other three for all the rest
        const double pixels = pixels_of(sample.tiles[0]);
        certain.weights.assign(4, (sample.frame_pixels - pixels) / (sample.pixels() - pixels));
        certain.weights[0] = 1;
        const PictureError weighted = error_of(films, reference, certain);
        CHECK(weighted.rmse == doctest::Approx(0.25 / std::sqrt(3 * sample.frame_pixels)));
        CHECK(weighted.off == doctest::Approx(1 / sample.frame_pixels));
        CHECK(weighted.flip == doctest::Approx(error.flip * sample.pixels() / sample.frame_pixels));
        CHECK(weighted.rmse_above < error.rmse_above);
        CHECK(weighted.rmse_above > weighted.rmse);
    }
    std::vector<Film> films{make_film(1, 1, {0, 0, 1, 1})};
    films[0].rgb[0][0] = 1.0f / 3;
    round_as_file(films, true);
    CHECK(films[0].rgb[0][0] == 1.0f / 3);
    round_as_file(films, false);
    CHECK(films[0].rgb[0][0] == 0.333251953125f);
}

TEST_CASE("every tile of a frame is looked at, and of frames too large for that as many as can be afforded") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> log_pixels(0, 28);
    std::uniform_int_distribution<int> tiles(1, 600), stretch(0, 2);
    for (int draw = 0; draw < 300; ++draw) {
        FrameOptions options;
        options.tile_size = 4 << stretch(random);
        options.width = options.tile_size * tiles(random);
        options.height = options.tile_size * tiles(random);
        const std::size_t count = every_tile(options).tiles.size();
        const double pixels = std::exp2(log_pixels(random));
        const TileSample sample = sample_to_look_at(options, pixels);
        const double looked_at = sample.pixels() / (sample.stride * sample.stride);
        CAPTURE(options.width);
        CAPTURE(options.height);
        CAPTURE(options.tile_size);
        CAPTURE(pixels);
        CHECK(sample.tiles.size() >= std::min(count, tiles_surely_looked_at));
        CHECK(sample.windows.size() == sample.tiles.size());
        CHECK(sample.pixels() <= 1 << 24);
        CHECK((looked_at <= pixels || (sample.stride == 4 && sample.tiles.size() <= tiles_surely_looked_at)));
        // nothing that can be afforded is left out
        if (sample.tiles.size() < count && sample.pixels() < (1 << 24) - 256) {
            CHECK(sample.stride == 4);
            CHECK((looked_at > pixels - 16 || sample.tiles.size() == tiles_surely_looked_at));
        }
        if (sample.stride > 1)
            CHECK(4 * std::min<double>(1 << 24, every_tile(options).pixels()) > pixels * sample.stride * sample.stride);
    }
}

TEST_CASE("a sample tells what depth changes, though it lies in few tiles and the machine may be as slow as it likes") {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-8, 8);
    for (int draw = 0; draw < (test::fewer > 1 ? 2 : 8); ++draw) {
        SceneDescription scene;
        scene.camera.position = {0, 0, 10};
        scene.camera.background = {1, 1, 1};
        scene.camera.field = 100;
        scene.lights.push_back(AmbientLight{{1, 1, 1}});
        scene.objects.resize(2);
        scene.objects[0].shape = Plane{{0, 0, -1}, {0, 0, 1}};
        scene.objects[0].material.ambient = {0.5, 0.5, 0.5};
        scene.objects[1].shape = Sphere{0.4, {place(random), place(random), 0}};
        scene.objects[1].material.reflective = {1, 1, 1};
        Choice base{scene.render, false};
        base.settings.depth = 8;
        const SceneArrays arrays = flatten(scene, base.settings, 2);
        Bench bench;
        bench.scene = &arrays;
        bench.camera = &scene.camera;
        bench.options.width = bench.options.height = 384;
        bench.options.threads = 2;
        const std::vector<Ladder> ladders = make_ladders(arrays, base, {}, bench.isa, 4);
        const auto square_error = [&] { // of depth 0
            RenderSettings deep = bare(base.settings), flat = deep;
            flat.depth = 0;
            const ReferencePicture truth = render_reference(bench, {deep, true});
            const double rmse = error_of(render(bench, flat).films, truth, bench.sample).rmse;
            return rmse * rmse;
        };
        bench.sample = every_tile(bench.options);
        const double of_frame = square_error();
        REQUIRE(of_frame > 0);
        for (const double seconds : {1e-9, 0.05, 5.0}) {
            CAPTURE(draw);
            CAPTURE(seconds);
            bench.sample = affordable_sample(bench, {true_choice(base, ladders)}, true_choice(base, ladders), ladders,
                                             {.seconds = seconds, .least_tiles = 64, .most_tiles = 160},
                                             [](double rmse) { return rmse * rmse; });
            CHECK(bench.sample.tiles.size() <= 162);
            const double of_sample = square_error();
            CHECK(of_sample > of_frame / 2);
            CHECK(of_sample < of_frame * 2);
        }
    }
}

TEST_CASE("trials of the reference are its own kernels', whose time a frame takes; the picture to compare with may come sooner") {
    Stage stage;
    RenderSettings settings = stage.base().settings;
    settings.precision = Precision::reference;
    const auto own = render_sample(find_kernels("auto", Precision::reference), stage.arrays, stage.scene.camera, settings,
                                   stage.bench.options, stage.bench.sample);
    const auto lanes = [](const RenderedSample& rendered) { return rendered.stats.kinds[0].first_lanes; };
    for (const char* isa : {"auto", "sse4.2"}) {
        stage.bench.isa = isa;
        const RenderedSample trial = render(stage.bench, settings), sooner = render_sooner(stage.bench, settings);
        CHECK(lanes(trial) == lanes(own));
        CHECK(test::film_difference(own.films[0], trial.films[0]) == "");
        CHECK(test::film_difference(own.films[0], sooner.films[0]) == "");
    }
}

TEST_CASE("single rays: the reference agrees with itself, balanced nearly, and what is broken is told by kind") {
    const Stage stage;
    RayLists rays = collect_rays(stage.bench, stage.base().settings, 20000);
    for (const RayList& list : rays) CHECK(list.size() > 100);
    for (const RayErrors& row : ray_errors(stage.bench, rays, find_kernels("auto", Precision::reference), "reference")) {
        CHECK(row.missed + row.false_hits + row.wrong_object == 0);
        CHECK(row.ulp_max == 0);
        CHECK(row.angle_max == 0);
    }
    for (const RayErrors& row : ray_errors(stage.bench, rays, find_kernels("auto", Precision::balanced), "balanced")) {
        CAPTURE(name_of(row.rays));
        CHECK(1000 * (row.missed + row.false_hits + row.wrong_object) < row.count);
        CHECK(row.ulp_p50 <= 2);
        CHECK(row.angle_p99 < 1e-3);
    }
    for (std::size_t i = 0; i < rays[0].size(); i += 200) rays[0].dir[1][i] = rays[0].dir[2][i] = 1e3f; // into the sky
    broken = find_kernels("auto", Precision::reference);
    broken.closest_hit = broken_hit;
    for (breakage = 0; breakage < 6; ++breakage) {
        CAPTURE(breakage);
        const RayErrors row = ray_errors(stage.bench, rays, broken, "broken").front();
        CHECK((row.missed > 0) == (breakage == 0));
        CHECK((row.false_hits > 0) == (breakage == 1));
        CHECK((row.wrong_object > 0) == (breakage == 2));
        CHECK(row.ulp_max == (breakage == 4 ? 2 : 0));
        CHECK((row.angle_max > 0) == (breakage == 5));
    }
}

TEST_CASE("an experiment: every value of every knob once, own errors are the knob's own, trials in order") {
    Stage stage;
    ExperimentOptions options;
    options.repetitions = 1;
    options.truth_samples = 9;
    options.rays = 2000;
    const Report report = run_experiment(stage.bench, stage.base(), options);
    CHECK(report.ladders.size() == knob_count);
    std::multiset<std::string> rows;
    int given = 0;
    for (const KnobRow& row : report.knobs) {
        rows.insert(std::string(name_of(row.knob)) + " " + row.value);
        given += row.given ? 1 : 0;
        if (row.given) CHECK(row.trial == 0);
        CHECK(label_of(row.knob, report.trials[row.trial].choice) == row.value);
        if (row.knob == Knob::precision && row.value == "reference") {
            CHECK(row.own.rmse == 0); // against itself
            CHECK(row.own.flip == 0);
        }
        if (row.knob == Knob::precision && row.value == "balanced") CHECK(row.own.rmse < 0.01);
    }
    CHECK(given == knob_count);
    CHECK(std::set(rows.begin(), rows.end()).size() == rows.size());
    for (const Ladder& ladder : report.ladders)
        for (const KnobValue& value : ladder.values)
            CHECK(rows.count(std::string(name_of(ladder.knob)) + " " + value.label) == 1);
    const auto own = [&](const std::string& name) {
        return std::ranges::find_if(report.knobs, [&](const KnobRow& r) { return name_of(r.knob) + (" " + r.value) == name; })
            ->own.rmse;
    };
    CHECK(own("anti-aliasing grid 8") < own("anti-aliasing grid 2"));
    CHECK(own("anti-aliasing grid 2") < own("anti-aliasing off"));
    CHECK(own("soft shadows 64") < own("soft shadows 4"));
    CHECK(own("soft shadows 4") < own("soft shadows 0"));
    CHECK(own("depth 4") < own("depth 0"));
    CHECK(own("file float") < own("file half"));
    for (const Trial& trial : report.trials) {
        CHECK(trial.seconds > 0);
        CHECK(trial.low <= trial.seconds);
        CHECK(trial.seconds <= trial.high);
        CHECK(trial.file_seconds > 0);
        CHECK(trial.rays >= 24 * 18);
    }
    CHECK(!report.walk.empty());
    CHECK(!report.front.empty());
    CHECK(!report.rays.empty());
}
