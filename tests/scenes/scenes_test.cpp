// Every scene we ship: it loads without a warning, says what it shows, and shows something.

#include "render/dispatch.hpp"
#include "render/renderer.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

std::vector<std::filesystem::path> shipped_scenes() {
    std::vector<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(LANECAST_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".json" && entry.path().filename() != "scene.schema.json") scenes.push_back(entry.path());
    std::ranges::sort(scenes);
    return scenes;
}

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

Film render_small(const SceneDescription& scene, RenderSettings settings) {
    settings.anti_aliasing.samples = std::min(settings.anti_aliasing.samples, 2);
    settings.soft_shadows = std::min(settings.soft_shadows, 4);
    const SceneArrays arrays = flatten(scene, settings, 2);
    CHECK(arrays.warnings.empty());
    CHECK(arrays.degenerate_triangles == 0);
    const FrameOptions options{.width = 64, .height = 36, .threads = 2};
    return render_frame(find_kernels("auto", settings.precision), arrays, scene.camera, settings, options).film;
}

struct PixelCounts {
    int not_finite = 0, negative = 0, background = 0, dark = 0;
};

PixelCounts count_pixels(const Film& film, const glm::dvec3& background) {
    PixelCounts counts;
    for (std::size_t i = 0; i < film.rgb[0].size(); ++i) {
        bool is_background = true, is_dark = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = film.rgb[c][i];
            counts.not_finite += !std::isfinite(value);
            counts.negative += value < 0;
            is_background &= value == static_cast<float>(background[static_cast<int>(c)]);
            is_dark &= value < 0.02f;
        }
        counts.background += is_background;
        counts.dark += is_dark;
    }
    return counts;
}

/// Pixels that differ between two settings of one scene.
int changed_pixels(const Film& a, const Film& b) {
    int changed = 0;
    for (std::size_t i = 0; i < a.rgb[0].size(); ++i)
        changed += a.rgb[0][i] != b.rgb[0][i] || a.rgb[1][i] != b.rgb[1][i] || a.rgb[2][i] != b.rgb[2][i];
    return changed;
}

} // namespace

TEST_CASE("every scene loads strictly and shows something") {
    const auto scenes = shipped_scenes();
    REQUIRE(scenes.size() >= 24);
    for (const auto& file : scenes) {
        const std::string name = file.stem().string();
        CAPTURE(name);
        CHECK(text_of(file).find("\"_comment\": \"") != std::string::npos);
        const LoadedScene scene = load_scene(file, {.strict = true});
        CHECK(scene.warnings.empty());
        const Film film = render_small(scene.description, scene.description.render);
        const PixelCounts counts = count_pixels(film, scene.description.camera.background);
        const int pixels = 64 * 36;
        CHECK(counts.not_finite == 0);
        CHECK(counts.negative == 0);
        if (name == "empty") {
            CHECK(counts.background == pixels);
            continue;
        }
        CHECK(counts.background < pixels * 9 / 10);
        if (name == "background") {
            CHECK(counts.background + counts.dark > pixels * 3 / 4); // silhouettes; the rest are their edges
            CHECK(counts.dark > pixels / 4);
        } else {
            CHECK(counts.background + counts.dark < pixels * 9 / 10); // objects are lit
        }
    }
}

TEST_CASE("each feature's scene shows its feature: without it the picture is another one") {
    struct Case {
        std::string name;
        void (*without)(SceneDescription&);
    };
    const Case cases[] = {
        {"attenuation",
         [](SceneDescription& s) {
             for (Light& l : s.lights)
                 if (auto* spot = std::get_if<SpotLight>(&l)) spot->attenuation = {1, 0, 0};
         }},
        {"anti_aliasing_cross", [](SceneDescription& s) { s.render.anti_aliasing.mode = AntiAliasMode::off; }},
        {"anti_aliasing_edge", [](SceneDescription& s) { s.render.anti_aliasing.mode = AntiAliasMode::off; }},
        {"anti_aliasing_grid", [](SceneDescription& s) { s.render.anti_aliasing.mode = AntiAliasMode::off; }},
        {"cone",
         [](SceneDescription& s) {
             for (Object& o : s.objects)
                 if (auto* cone = std::get_if<Cone>(&o.shape)) cone->apex_radius = cone->base_radius;
         }},
        {"depth", [](SceneDescription& s) { s.render.depth = 8; }},
        {"look_at",
         [](SceneDescription& s) {
             s.camera.up = {1, 0, 0};
         }},
        {"many_lights", [](SceneDescription& s) { s.lights.resize(s.lights.size() / 2); }},
        {"material", [](SceneDescription& s) { s.render.specular = false; }},
        {"near", [](SceneDescription& s) { s.camera.near = 0; }},
        {"plane", [](SceneDescription& s) { s.render.planes = false; }},
        {"reflection", [](SceneDescription& s) { s.render.reflections = false; }},
        {"refraction", [](SceneDescription& s) { s.render.refraction = false; }},
        {"schlick", [](SceneDescription& s) { s.render.schlick = false; }},
        {"showcase", [](SceneDescription& s) { s.render.transmissive_shadows = false; }},
        {"soft_shadows", [](SceneDescription& s) { s.render.soft_shadows = 0; }},
        {"spot",
         [](SceneDescription& s) {
             for (Light& l : s.lights)
                 if (auto* spot = std::get_if<SpotLight>(&l)) spot->cutoff = 90;
         }},
        {"transformations",
         [](SceneDescription& s) {
             for (Object& o : s.objects) o.transformations.clear();
         }},
        {"transmissive_shadows", [](SceneDescription& s) { s.render.transmissive_shadows = false; }},
    };
    for (const auto& [name, without] : cases) {
        CAPTURE(name);
        const auto file = std::filesystem::path(LANECAST_SOURCE_DIR "/scenes") / (name + ".json");
        SceneDescription scene = load_scene(file, {.strict = true}).description;
        const Film with_it = render_small(scene, scene.render);
        without(scene);
        CHECK(changed_pixels(with_it, render_small(scene, scene.render)) > 64 * 36 / 50);
    }
}

TEST_CASE("the README's scene loads strictly and shows something") {
    const std::string readme = text_of(LANECAST_SOURCE_DIR "/README.md");
    const std::string fence = "```json\n";
    const std::size_t begin = readme.find(fence);
    REQUIRE(begin != std::string::npos);
    const std::string text = readme.substr(begin + fence.size(), readme.find("```", begin + fence.size()) - begin - fence.size());
    const LoadedScene scene = parse_scene(text, "README.md", LANECAST_SOURCE_DIR "/scenes", {.strict = true});
    const PixelCounts counts =
        count_pixels(render_small(scene.description, scene.description.render), scene.description.camera.background);
    CHECK(counts.not_finite == 0);
    CHECK(counts.background < 64 * 36 / 2);
}
