// N5: a picture says nothing of the unit of length.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/leaf_tree.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "scene/flatten.hpp"

namespace lanecast::selftest {

void test_scaled_scene(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const std::uint64_t end = tally.rays + block.rays;
    while (tally.rays < end) {
        const SceneDescription scene = random_lit_scene(s.primitive, s.placing, 4 + random.below(20), random);
        const SceneArrays arrays = with_leaves_of(flatten(scene, RenderSettings{}, 1), s.leaf_size);
        const Picture picture = render(*s.kernels, arrays, scene.camera, RenderSettings{}, 48, 32);
        const int k = random.below(201) - 100;
        const SceneDescription scaled = scaled_scene(scene, k);
        const SceneArrays scaled_arrays = with_leaves_of(flatten(scaled, RenderSettings{}, 1), s.leaf_size);
        const Picture other = render(*s.kernels, scaled_arrays, scaled.camera, RenderSettings{}, 48, 32);
        std::size_t first = 0;
        if (const std::uint64_t wrong = differing_pixels(picture.film, other.film, first); wrong > 0) {
            tally.fail("k = " + std::to_string(k) + ", pixel " + std::to_string(first));
            tally.failures += wrong - 1;
        }
        tally.rays += picture.rays() + other.rays();
    }
}

} // namespace lanecast::selftest
