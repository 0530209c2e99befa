// N14, N15: input that no picture can be made of.

#include "cli/selftest/cases.hpp"
#include "cli/selftest/picture.hpp"
#include "cli/selftest/scenes.hpp"
#include "scene/error.hpp"
#include "scene/flatten.hpp"
#include "scene/load_scene.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace lanecast::selftest {
namespace {

const char* awkward(Random& random) {
    constexpr const char* numbers[] = {"0",     "1",     "-1",    "0.5",  "1e20",  "-1e20", "1e-20",   "1e-45", "1e38",
                                       "-1e38", "3e38",  "1e300", "180",  "179.9", "90",    "1e-300",  "-0.0",  "1e9",
                                       "2",     "1e400", "NaN",   "1e15", "65504", "1e-8",  "16777217"};
    return numbers[static_cast<std::size_t>(random.below(std::size(numbers)))];
}
/// Mostly an ordinary number, or no scene would get past the loader.
std::string number(Random& random, double ordinary, double odd) {
    return random.chance(odd) ? awkward(random) : std::to_string(ordinary);
}
std::string triple(Random& random, double size, double odd) {
    const glm::dvec3 p = random.point(size);
    if (random.chance(odd / 8)) return "[0,0,0]";
    return "[" + number(random, p.x, odd) + "," + number(random, p.y, odd) + "," + number(random, p.z, odd) + "]";
}

std::string shape(Random& random, double odd) {
    switch (random.below(5)) {
    case 0:
        return R"("type":"sphere","radius":)" + number(random, 1, odd) + R"(,"position":)" + triple(random, 2, odd);
    case 1:
        return R"("type":"cylinder","radius":)" + number(random, 1, odd) + R"(,"height":)" + number(random, 1, odd) +
               (random.chance(0.5) ? R"(,"capped":false)" : "");
    case 2:
        return R"("type":"cone","base_radius":)" + number(random, 1, odd) + R"(,"apex_radius":)" + number(random, 0, odd) +
               R"(,"height":)" + number(random, 1, odd) + (random.chance(0.5) ? R"(,"capped":false)" : "");
    case 3:
        return R"("type":"plane","position":)" + triple(random, 2, odd) + R"(,"normal":)" + triple(random, 1, odd);
    default: {
        const std::string first = triple(random, 2, odd);
        const std::string second = random.chance(0.2) ? first : triple(random, 2, odd);
        return R"("type":"mesh","triangles":[[)" + first + "," + second + "," + triple(random, 2, odd) + "]]";
    }
    }
}

std::string torture_scene(Random& random) {
    const double odd = random.magnitude(0.003, 0.3);
    const auto positive = [&] { return "[" + number(random, 0.5, odd) + ",0.5," + number(random, 0.2, odd) + "]"; };
    std::string text = R"({"camera":{"field":)" + number(random, 60, odd) + R"(,"background":)" + positive() + R"(,"position":)" +
                       triple(random, 5, odd) + R"(,"look_at":)" + triple(random, 1, odd) + R"(},"objects":[)";
    const int objects = random.below(6);
    for (int i = 0; i < objects; ++i) {
        text += std::string(i > 0 ? "," : "") + "{" + shape(random, odd) + R"(,"material":{"ambient":)" + positive() +
                R"(,"diffuse":)" + positive() + R"(,"specular":)" + positive() + R"(,"shininess":)" + number(random, 10, odd);
        if (random.chance(0.5)) text += R"(,"reflective":)" + positive();
        if (random.chance(0.4)) text += R"(,"transmissive":)" + positive() + R"(,"refraction":)" + number(random, 1.5, odd);
        text += "}";
        if (random.chance(0.3) && text.find("plane", text.size() > 300 ? text.size() - 300 : 0) == std::string::npos)
            text += R"(,"transformations":[{"type":"scale","scale":)" + triple(random, 2, odd) + "}]";
        text += "}";
    }
    text += R"(],"lights":[)";
    const int lights = random.below(4);
    for (int i = 0; i < lights; ++i) {
        text += i > 0 ? "," : "";
        if (i == 0)
            text += R"({"type":"ambient","color":)" + positive() + "}";
        else if (random.chance(0.5))
            text += R"({"type":"directional","color":)" + positive() + R"(,"direction":)" + triple(random, 1, odd) +
                    R"(,"angle":)" + number(random, 5, odd) + "}";
        else
            text += (random.chance(0.5) ? R"({"type":"point")"
                                        : R"({"type":"spot","cutoff":)" + number(random, 60, odd) + R"(,"direction":)" +
                                              triple(random, 1, odd)) +
                    R"(,"color":)" + positive() + R"(,"position":)" + triple(random, 5, odd) + R"(,"attenuation":)" + positive() +
                    R"(,"radius":)" + number(random, 0.5, odd) + "}";
    }
    return text + "]}";
}

double processor_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace

/// A message or a picture without a NaN; a crash would end the program.
void test_torture(const Block& block, Tally& tally) {
    for_each_picture(block, tally, [&](Random& random) {
        RenderSettings settings;
        settings.depth = 4;
        settings.schlick = random.chance(0.5);
        settings.transmissive_shadows = random.chance(0.5);
        settings.soft_shadows = 2 * random.below(2);
        const std::string text = torture_scene(random);
        std::uint64_t rays = 1; // the text
        try {
            const LoadedScene loaded = parse_scene(text, "torture", ".");
            const SceneArrays scene = flatten(loaded.description, settings, 1);
            const Picture picture = render(*block.setting.kernels, scene, loaded.description.camera, settings, 16, 16, 16);
            std::uint64_t bad = 0;
            for (const auto& plane : picture.film.rgb)
                bad +=
                    static_cast<std::uint64_t>(std::count_if(plane.begin(), plane.end(), [](float x) { return std::isnan(x); }));
            if (bad > 0) tally.fail("NaN in the picture of " + text);
            rays += picture.rays();
        } catch (const Error& error) {
            if (*error.what() == 0) tally.fail("no message for " + text);
        }
        return rays;
    });
}

namespace {

/// One ray in four becomes none: NaN, infinities, no direction, or numbers beyond the range of rays.
std::vector<bool> spoil(Rays& rays, Random& random) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    std::vector<bool> is_bad(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        is_bad[i] = random.chance(0.25);
        if (!is_bad[i]) continue;
        const float what = random.chance(0.5) ? nan : random.chance(0.5) ? infinity : -infinity;
        const int axis = random.below(3), kind = random.below(4);
        if (kind == 0) rays.org[axis][i] = what;
        if (kind == 1) rays.dir[axis][i] = what;
        if (kind == 2)
            for (auto& component : rays.dir) component[i] = random.chance(0.5) ? 0.0f : -0.0f;
        if (kind == 3)
            (random.chance(0.5) ? rays.org : rays.dir)[axis][i] =
                static_cast<float>(random.magnitude(1e35, 3e38) * (random.chance(0.5) ? 1 : -1));
    }
    return is_bad;
}

} // namespace

void test_bad_rays(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneArrays scene = flatten(random_scene(s.primitive, s.placing, 30, random), RenderSettings{}, 1);
    const Rays good = random_rays(scene, block.rays, 100, random);
    Rays spoilt = good;
    const std::vector<bool> is_bad = spoil(spoilt, random);
    const Hits before = ask(*s.kernels, view(scene), good, s.path), after = ask(*s.kernels, view(scene), spoilt, s.path);
    const Hits any = ask(*s.kernels, view(scene), spoilt, s.path, Query::any);
    for (std::size_t i = 0; i < good.size(); ++i) {
        if (is_bad[i] && (after.slot[i] >= 0 || any.slot[i] >= 0)) tally.fail("ray " + std::to_string(i) + " is none and hits");
        if (!is_bad[i] && (after.slot[i] != before.slot[i] || bits_of(after.t[i]) != bits_of(before.t[i])))
            tally.fail("ray " + std::to_string(i) + " was changed by a bad one beside it");
    }
    tally.rays += good.size();
}

/// Processor time with bad rays over that without.
void test_bad_ray_time(const Block& block, Tally& tally) {
    Random random(block.seed);
    const Setting& s = block.setting;
    const SceneArrays scene = flatten(random_scene(s.primitive, s.placing, 60, random), RenderSettings{}, 1);
    const Rays good = random_rays(scene, block.rays, 100, random);
    Rays spoilt = good;
    static_cast<void>(spoil(spoilt, random));
    double best[2] = {1e30, 1e30};
    for (int round = 0; round < 7; ++round)
        for (const bool bad : {false, true}) {
            const double begin = processor_seconds();
            static_cast<void>(ask(*s.kernels, view(scene), bad ? spoilt : good, s.path));
            best[bad ? 1 : 0] = std::min(best[bad ? 1 : 0], processor_seconds() - begin);
        }
    tally.add_error(best[1] / best[0]);
    tally.rays += 14 * good.size();
}

} // namespace lanecast::selftest
