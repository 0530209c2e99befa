// N5, N20, N23: pictures say nothing of the unit of length, nor of threads and tiles; and which preset is the most accurate.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "render/dispatch.hpp"
#include "scene/flatten.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast::selftest {

void test_scaled_scene(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        const SceneDescription scene = random_lit_scene(s.primitive, s.placing, 4 + random.below(20), random);
        const SceneArrays arrays = with_leaves_of(flatten(scene, RenderSettings{}, 1), s.leaf_size);
        const Picture picture = render(*s.kernels, arrays, scene.camera, RenderSettings{}, 48, 32);
        const int k = random.below(201) - 100;
        const SceneDescription scaled = scaled_scene(scene, k);
        const SceneArrays scaled_arrays = with_leaves_of(flatten(scaled, RenderSettings{}, 1), s.leaf_size);
        const Picture other = render(*s.kernels, scaled_arrays, scaled.camera, RenderSettings{}, 48, 32);
        std::size_t first = 0;
        if (const std::uint64_t wrong = differing_pixels(picture.film, other.film, first); wrong > 0)
            tally.fail("k = " + std::to_string(k) + ", pixel " + std::to_string(first), wrong);
        return picture.rays() + other.rays();
    });
}

/// Threads, tile sizes and crops.
void test_threads(const Block& block, Tally& tally) {
    const Setting& s = block.setting;
    for_each_picture(block, tally, [&](Random& random) {
        SceneDescription scene = random_lit_scene(s.primitive, s.placing, 4 + random.below(20), random);
        RenderSettings settings;
        settings.transmissive_shadows = random.chance(0.2);
        if (random.chance(0.3)) { // where each pixel has its own samples of a light
            settings.soft_shadows = 1 + random.below(3);
            for (Light& any : scene.lights)
                std::visit(
                    [&](auto& light) {
                        if constexpr (requires { light.radius; }) light.radius = random.uniform(0, 1);
                        if constexpr (requires { light.angle; }) light.angle = random.uniform(0, 10);
                    },
                    any);
        }
        if (random.chance(0.5)) {
            settings.anti_aliasing.mode = random.chance(0.5) ? AntiAliasMode::edge : AntiAliasMode::cross;
            settings.anti_aliasing.samples = 2;
        }
        const SceneArrays arrays = with_leaves_of(flatten(scene, settings, 1), s.leaf_size);
        FrameOptions options;
        options.width = 61, options.height = 43;
        const Frame whole = render_frame(*s.kernels, arrays, scene.camera, settings, options);
        options.threads = 2 + random.below(3);
        options.tile_size = 1 + random.below(64);
        const int x = random.below(40), y = random.below(30);
        if (random.chance(0.5)) options.crop = {x, y, x + 1 + random.below(20), y + 1 + random.below(12)};
        const Frame part = render_frame(*s.kernels, arrays, scene.camera, settings, options);
        for (int row = 0; row < part.film.height; ++row)
            for (int column = 0; column < part.film.width; ++column)
                for (std::size_t c = 0; c < 3; ++c) {
                    const int image_x = part.film.x0 + column, image_y = part.film.y0 + row;
                    const auto here = static_cast<std::size_t>(row * part.film.width + column);
                    const auto there = static_cast<std::size_t>(image_y * whole.film.width + image_x);
                    if (bits_of(part.film.rgb[c][here]) != bits_of(whole.film.rgb[c][there]))
                        tally.fail("pixel " + std::to_string(image_x) + ", " + std::to_string(image_y) + " with " +
                                   std::to_string(options.threads) + " threads, tiles of " + std::to_string(options.tile_size));
                }
        return ray_count(whole.stats.tiles) + ray_count(part.stats.tiles);
    });
}

namespace {

/// p99 of |t - t_reference| in ulp, over the rays that both say hit the same: of all, and of each half, whose difference is the
/// noise.
struct Errors {
    double p99, noise;
};
Errors errors_of(const KernelTable& kernels, const SceneView& scene, const Rays& rays, const Hits& truth) {
    const Hits hits = ask(kernels, scene, rays, Path::batch);
    Tally all, half[2];
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits.slot[i] < 0 || hits.slot[i] != truth.slot[i]) continue;
        const double error = ulps(hits.t[i], double{truth.t[i]});
        all.add_error(error), half[i % 2].add_error(error);
    }
    return {all.percentile(0.99), std::fabs(half[0].percentile(0.99) - half[1].percentile(0.99))};
}

double rmse(const Film& a, const Film& b) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < a.rgb[c].size(); ++i) {
            const double difference = double{a.rgb[c][i]} - double{b.rgb[c][i]};
            sum += difference * difference;
        }
    return std::sqrt(sum / (3 * static_cast<double>(a.rgb[0].size())));
}

} // namespace

/// `fast` should not be nearer to the reference than `balanced`: in p99 of t by more than its noise, in RMSE of a picture by more
/// than half. The error is the ratio of the two RMSE.
void test_preset_order(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    if (s.kernels->precision != Precision::fast) return;
    const KernelTable& balanced = find_kernels(s.kernels->isa, Precision::balanced);
    const KernelTable& reference = find_kernels("auto", Precision::reference);
    const SceneDescription scene = random_lit_scene(s.primitive, s.placing, 4 + random.below(20), random);
    const SceneArrays arrays = with_leaves_of(flatten(scene, RenderSettings{}, 1), s.leaf_size);
    const Rays rays = random_rays(arrays, block.rays, 100, random);
    const Hits truth = ask(reference, view(arrays), rays, Path::batch);
    const Errors of_fast = errors_of(*s.kernels, view(arrays), rays, truth);
    const Errors of_balanced = errors_of(balanced, view(arrays), rays, truth);
    if (of_balanced.p99 > of_fast.p99 + of_fast.noise + of_balanced.noise)
        tally.fail("p99 of t: fast " + std::to_string(of_fast.p99) + " ulp, balanced " + std::to_string(of_balanced.p99));
    const Film exact = render(reference, arrays, scene.camera, RenderSettings{}, 48, 32).film;
    const double fast_rmse = rmse(render(*s.kernels, arrays, scene.camera, RenderSettings{}, 48, 32).film, exact);
    const double balanced_rmse = rmse(render(balanced, arrays, scene.camera, RenderSettings{}, 48, 32).film, exact);
    if (balanced_rmse > 1.5 * fast_rmse && balanced_rmse > 1e-6)
        tally.fail("RMSE: fast " + std::to_string(fast_rmse) + ", balanced " + std::to_string(balanced_rmse));
    tally.rays += 2 * rays.size();
}

} // namespace lanecast::selftest
