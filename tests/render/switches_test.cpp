// Each switch changes what it should, and nothing else; and a scene is not charged for what it does not use.

#include "render/render_support.hpp"
#include "render/tiles.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

using namespace lanecast;
using namespace lanecast::test;

namespace {

const KernelTable& fastest() { return *balanced_kernels().back(); }

Film film_of(const SceneDescription& scene, const RenderSettings& settings) {
    return shoot(fastest(), scene, Shot{{64, 48, {0, 0, 0, 0}, 1, 32}, settings}).film;
}

/// A room of matte bodies under all lights: what the light switches act on.
SceneDescription matte_scene() {
    SceneDescription scene = everything();
    for (Object& object : scene.objects) object.material.reflective = object.material.transmissive = glm::dvec3(0);
    return scene;
}

struct Change {
    int same = 0, brighter = 0, darker = 0;
};
Change compare(const Film& before, const Film& after) {
    Change change;
    for (std::size_t i = 0; i < before.rgb[0].size(); ++i) {
        bool up = false, down = false;
        for (std::size_t c = 0; c < 3; ++c) {
            up |= after.rgb[c][i] > before.rgb[c][i];
            down |= after.rgb[c][i] < before.rgb[c][i];
        }
        ++(up ? change.brighter : down ? change.darker : change.same);
        CHECK(!(up && down));
    }
    return change;
}

/// The film of a job changed by `edit`, straight from the kernels.
template <class Edit>
Film film_of_job(const SceneDescription& scene, const RenderSettings& settings, Edit&& edit) {
    const FrameOptions options{64, 48, {0, 0, 0, 0}, 1, 64};
    const SceneArrays arrays = flatten(scene, settings, 1);
    RenderJob job = make_job(arrays, scene.camera, settings, options);
    const PixelOrder order = morton_order(options.tile_size);
    job.pixel_order[0] = order.x.data();
    job.pixel_order[1] = order.y.data();
    job.pixel_order_count = order.count;
    edit(job);
    Film film = make_film(64, 48, {0, 0, 64, 48});
    job.film = view(film);
    const std::unique_ptr<void, void (*)(void*)> scratch(::operator new (fastest().scratch_bytes(job), std::align_val_t{64}),
                                                         [](void* p) { ::operator delete (p, std::align_val_t{64}); });
    fastest().render_tile(job, {0, 0, 64, 48}, scratch.get());
    return film;
}

/// Camera rays through the pixels' points (x + dx, y + dy), one each: exact for dx and dy that are few bits.
Film shifted(const SceneDescription& scene, const RenderSettings& settings, float dx, float dy) {
    RenderSettings single = settings;
    single.anti_aliasing.mode = AntiAliasMode::off;
    return film_of_job(scene, single, [&](RenderJob& job) {
        job.camera.half_width -= dx - 0.5f;
        job.camera.half_height -= dy - 0.5f;
    });
}

/// Sum in order, then one division: as the renderer promises.
Film mean(const std::vector<Film>& films) {
    Film result = films.front();
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < result.rgb[c].size(); ++i) {
            float sum = 0;
            for (const Film& film : films) sum += film.rgb[c][i];
            result.rgb[c][i] = sum / static_cast<float>(films.size());
        }
    return result;
}

std::uint64_t rays_of(const Frame& frame, RayKind kind) { return frame.stats.tiles.kinds[static_cast<int>(kind)].rays; }

Frame frame_of(const SceneDescription& scene, const RenderSettings& settings) {
    return shoot(fastest(), scene, Shot{{64, 48, {0, 0, 0, 0}, 1, 32}, settings});
}

std::uint64_t scratch_of(const SceneDescription& scene, const RenderSettings& settings) {
    const SceneArrays arrays = flatten(scene, settings, 1);
    return fastest().scratch_bytes(make_job(arrays, scene.camera, settings, FrameOptions{}));
}

} // namespace

TEST_CASE("ambient, diffuse and specular are three summands of the local light") {
    const SceneDescription scene = matte_scene();
    const auto only = [&](bool ambient, bool diffuse, bool specular) {
        RenderSettings s;
        s.ambient = ambient, s.diffuse = diffuse, s.specular = specular;
        return film_of(scene, s);
    };
    const Film all = only(true, true, true), a = only(true, false, false), d = only(false, true, false),
               s = only(false, false, true);
    const Film none = only(false, false, false);
    double largest_a = 0, largest_d = 0, largest_s = 0;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < all.rgb[c].size(); ++i) {
            const bool background = a.rgb[c][i] != 0 && none.rgb[c][i] != 0;
            if (background) continue;
            const double sum =
                static_cast<double>(a.rgb[c][i]) + static_cast<double>(d.rgb[c][i]) + static_cast<double>(s.rgb[c][i]);
            CHECK(static_cast<double>(all.rgb[c][i]) == doctest::Approx(sum).epsilon(1e-5));
            largest_a = std::fmax(largest_a, static_cast<double>(a.rgb[c][i]));
            largest_d = std::fmax(largest_d, static_cast<double>(d.rgb[c][i]));
            largest_s = std::fmax(largest_s, static_cast<double>(s.rgb[c][i]));
        }
    CHECK(largest_a > 0.05);
    CHECK(largest_d > 0.05);
    CHECK(largest_s > 0.05);
}

TEST_CASE("shadows off: what was in shadow gets brighter, nothing else changes, and no shadow ray is traced") {
    RenderSettings on, off;
    off.shadows = false;
    const Frame before = frame_of(matte_scene(), on), after = frame_of(matte_scene(), off);
    const Change change = compare(before.film, after.film);
    CHECK(change.darker == 0);
    CHECK(change.brighter > 200);
    CHECK(change.same > 200);
    CHECK(rays_of(before, RayKind::shadow) > 0);
    CHECK(rays_of(after, RayKind::shadow) == 0);
}

TEST_CASE("reflections and transmission off: as if no material had them") {
    for (const bool reflections : {true, false}) {
        RenderSettings s;
        (reflections ? s.reflections : s.transmission) = false;
        SceneDescription without = everything();
        for (Object& object : without.objects)
            (reflections ? object.material.reflective : object.material.transmissive) = glm::dvec3(0);
        const Frame off = frame_of(everything(), s);
        CHECK(film_difference(off.film, film_of(without, RenderSettings{})) == "");
        CHECK(film_difference(off.film, film_of(everything(), RenderSettings{})) != "");
        CHECK(rays_of(off, reflections ? RayKind::reflection : RayKind::refraction) == 0);
        CHECK(rays_of(off, reflections ? RayKind::refraction : RayKind::reflection) > 0);
    }
}

TEST_CASE("refraction off: as if no material had an index") {
    RenderSettings s;
    s.refraction = false;
    SceneDescription without = everything();
    for (Object& object : without.objects) object.material.refraction = 0;
    CHECK(film_difference(film_of(everything(), s), film_of(without, RenderSettings{})) == "");
    CHECK(film_difference(film_of(everything(), s), film_of(everything(), RenderSettings{})) != "");
}

TEST_CASE("schlick: changes only what materials with an index reflect") {
    RenderSettings s;
    s.schlick = true;
    CHECK(film_difference(film_of(everything(), s), film_of(everything(), RenderSettings{})) != "");
    SceneDescription no_index = everything();
    for (Object& object : no_index.objects) object.material.refraction = 0;
    CHECK(film_difference(film_of(no_index, s), film_of(no_index, RenderSettings{})) == "");
    SceneDescription no_mirror = everything();
    for (Object& object : no_mirror.objects) object.material.reflective = glm::dvec3(0);
    CHECK(film_difference(film_of(no_mirror, s), film_of(no_mirror, RenderSettings{})) == "");
}

TEST_CASE("planes off: as if the file had none") {
    RenderSettings s;
    s.planes = false;
    SceneDescription without = everything();
    std::erase_if(without.objects, [](const Object& object) { return std::holds_alternative<Plane>(object.shape); });
    CHECK(film_difference(film_of(everything(), s), film_of(without, RenderSettings{})) == "");
    CHECK(film_difference(film_of(everything(), s), film_of(everything(), RenderSettings{})) != "");
}

TEST_CASE("depth 0 traces camera and shadow rays only; a deeper limit is reached and then changes nothing") {
    RenderSettings s;
    s.depth = 0;
    const Frame flat = frame_of(everything(), s);
    CHECK(rays_of(flat, RayKind::reflection) + rays_of(flat, RayKind::refraction) == 0);
    CHECK(rays_of(flat, RayKind::shadow) > 0);
    SceneDescription mirrors = everything(); // convex mirrors over a matte floor: no path is longer than a few bounces
    for (Object& object : mirrors.objects) {
        object.material.transmissive = glm::dvec3(0);
        if (!std::holds_alternative<Sphere>(object.shape)) object.material.reflective = glm::dvec3(0);
    }
    std::uint64_t before = 0;
    for (const int depth : {1, 2, 3}) {
        s.depth = depth;
        const std::uint64_t now = rays_of(frame_of(mirrors, s), RayKind::reflection);
        CHECK(now > before);
        before = now;
    }
    s.depth = 30;
    const Frame deep = frame_of(mirrors, s);
    s.depth = 60;
    CHECK(film_difference(deep.film, film_of(mirrors, s)) == "");
}

TEST_CASE("a ray past the depth returns the background: two facing mirrors") {
    SceneDescription scene;
    scene.camera.background = {0.25, 0.5, 1};
    Material mirror;
    mirror.ambient = glm::dvec3(0.125);
    mirror.reflective = glm::dvec3(0.5);
    scene.objects.push_back({Plane{{0, 0, -1}, {0, 0, 1}}, {}, mirror, ""});
    scene.objects.push_back({Plane{{0, 0, 1}, {0, 0, 1}}, {}, mirror, ""});
    scene.lights.emplace_back(AmbientLight{glm::dvec3(1)});
    for (const int depth : {0, 1, 2, 5}) {
        RenderSettings s;
        s.depth = depth;
        const Film film = film_of(scene, s);
        const double share = std::ldexp(1.0, -(depth + 1)); // of what lies behind the last mirror
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = 0.25 * (1 - share) + share * scene.camera.background[static_cast<int>(c)];
            CHECK(static_cast<double>(film.rgb[c][24 * 64 + 32]) == doctest::Approx(expected).epsilon(1e-6));
        }
    }
}

TEST_CASE("cut-off: 0 is off, a huge one is depth 0, between them it drops rays and little light") {
    RenderSettings s, flat;
    flat.depth = 0;
    const Frame full = frame_of(everything(), s);
    s.cutoff = 1e-30;
    CHECK(film_difference(full.film, film_of(everything(), s)) == "");
    s.cutoff = 1e9;
    const Frame cut = frame_of(everything(), s);
    CHECK(film_difference(cut.film, film_of(everything(), flat)) == "");
    CHECK(rays_of(cut, RayKind::reflection) + rays_of(cut, RayKind::refraction) == 0);
    s.cutoff = 0.01;
    const Frame some = frame_of(everything(), s);
    CHECK(rays_of(some, RayKind::reflection) < rays_of(full, RayKind::reflection));
    CHECK(rays_of(some, RayKind::reflection) > 0);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < some.film.rgb[c].size(); ++i)
            CHECK(std::fabs(some.film.rgb[c][i] - full.film.rgb[c][i]) < 0.25f);
}

TEST_CASE("transmissive shadows: light is multiplied by every surface on its way; opaque ones stay black") {
    SceneDescription scene;
    scene.camera.position = {0, 0, 5};
    scene.camera.field = 20;
    Material floor;
    floor.diffuse = glm::dvec3(1);
    scene.objects.push_back({Plane{{0, 0, 0}, {0, 0, 1}}, {}, floor, ""});
    const auto pane = [](double z, const glm::dvec3& color) {
        Object object{Plane{{0, 0, z}, {0, 0, 1}}, {}, {}, ""};
        object.material.transmissive = color;
        return object;
    };
    scene.lights.emplace_back(DirectionalLight{glm::dvec3(1), {0, 0, -1}, 0});
    RenderSettings s;
    s.transmissive_shadows = true;
    const auto centre = [&](const SceneDescription& d) {
        const Film film = film_of(d, s);
        return glm::dvec3(film.rgb[0][24 * 64 + 32], film.rgb[1][24 * 64 + 32], film.rgb[2][24 * 64 + 32]);
    };
    CHECK(centre(scene) == glm::dvec3(1));
    SceneDescription two = scene; // behind the camera: seen by the light only
    two.objects.push_back(pane(6, {0.5, 0.25, 1}));
    two.objects.push_back(pane(7, {0.5, 1, 0.75}));
    CHECK(centre(two) == glm::dvec3(0.25, 0.25, 0.75));
    two.objects.push_back({Sphere{0.5, {0, 0, 8}}, {}, two.objects[1].material, ""}); // twice
    CHECK(centre(two) == glm::dvec3(0.0625, 0.015625, 0.75));
    two.objects.push_back(pane(7, {0.5, 0.5, 0.5})); // coincident with another pane: both count
    CHECK(centre(two) == glm::dvec3(0.03125, 0.0078125, 0.375));
    two.objects.push_back(pane(20, {0, 0, 0}));
    CHECK(centre(two) == glm::dvec3(0));
    s.transmissive_shadows = false;
    two.objects.pop_back();
    CHECK(centre(two) == glm::dvec3(0));
    // beyond a point light nothing counts
    s.transmissive_shadows = true;
    scene.lights.front() = PointLight{glm::dvec3(1), {0, 0, 6.5}, {1, 0, 0}, 0};
    scene.objects.push_back(pane(7, {0.5, 0.5, 0.5}));
    CHECK(centre(scene).x == doctest::Approx(1).epsilon(1e-4));
    scene.objects.push_back(pane(6, {0.5, 0.5, 0.5}));
    CHECK(centre(scene).x == doctest::Approx(0.5).epsilon(1e-4));
}

TEST_CASE("transmissive shadows: kernels are asked for them only where something transmits") {
    const SceneDescription scene = everything();
    RenderSettings s;
    s.transmissive_shadows = true;
    const auto job = [&] { return make_job(flatten(scene, s, 1), scene.camera, s, FrameOptions{}); };
    CHECK(job().transmissive_shadows == 1);
    s.transmission = false;
    CHECK(job().transmissive_shadows == 0);
}

TEST_CASE("soft shadows: only lights with an extent, and a half-covered disc gives its covered share") {
    // without extents nothing changes
    SceneDescription hard = everything();
    for (Light& any : hard.lights)
        std::visit(
            [](auto& light) {
                if constexpr (requires { light.radius; }) light.radius = 0;
                if constexpr (requires { light.angle; }) light.angle = 0;
            },
            any);
    RenderSettings soft;
    soft.soft_shadows = 16;
    CHECK(film_difference(film_of(hard, RenderSettings{}), film_of(hard, soft)) == "");
    CHECK(film_difference(film_of(everything(), RenderSettings{}), film_of(everything(), soft)) != "");
    RenderSettings off;
    CHECK(film_difference(film_of(everything(), off), film_of(hard, off)) == ""); // extents alone change nothing

    // A disc of radius 1 at height 4, a half-plane's edge (a long thin box of two triangles) at height 2: from (x, 0, 0) the edge
    // covers the part of the disc left of 2 * 0 - x.
    SceneDescription scene;
    scene.camera.position = {0, 0.5, 0};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 0, -1};
    scene.camera.field = 90; // the film is 64/48 wide and 1 high: x from -2/3 to 2/3
    Material floor;
    floor.diffuse = glm::dvec3(1);
    scene.objects.push_back({Plane{{0, 0, 0}, {0, 1, 0}}, {}, floor, ""});
    const glm::dvec3 a(0, 2, -50), b(0, 2, 50), c(-50, 2, 50), d(-50, 2, -50);
    scene.objects.push_back({triangle_mesh({{a, b, c}, {a, c, d}}), {}, {}, ""});
    scene.lights.emplace_back(PointLight{glm::dvec3(1), {0, 4, 0}, {1, 0, 0}, 1});
    RenderSettings many, one;
    many.soft_shadows = 256;
    one.shadows = false;
    const Film shaded = film_of(scene, many), bright = film_of(scene, one);
    double worst = 0;
    int partly = 0;
    for (int x = 0; x < 64; ++x) {
        const auto i = static_cast<std::size_t>(24 * 64 + x);
        const double p = (x + 0.5 - 32) / 48; // on the floor
        const double edge = -p;               // the ray from (p, 0) through (0, 2) meets height 4 at -p
        // share of the unit disc right of `edge`; the disc faces the point, which tilts it by little
        const double e = std::fmin(std::fmax(edge, -1.0), 1.0);
        const double share = (std::acos(e) - e * std::sqrt(1 - e * e)) / 3.14159265358979;
        const double measured = static_cast<double>(shaded.rgb[0][i]) / static_cast<double>(bright.rgb[0][i]);
        worst = std::fmax(worst, std::fabs(measured - share));
        partly += measured > 0.05 && measured < 0.95;
    }
    MESSAGE("penumbra: worst difference from the covered share ", worst);
    CHECK(partly > 30);
    CHECK(worst < 0.03);
}

TEST_CASE("cross is the mean of five pictures, moved up, down, left and right; where the centre ray hits, or not on planes") {
    RenderSettings s;
    s.anti_aliasing = {AntiAliasMode::cross, 4, 0.25, true};
    s.depth = 3;
    const SceneDescription scene = everything();
    const Film centre = shifted(scene, s, 0.5f, 0.5f);
    const Film averaged = mean({centre, shifted(scene, s, 0.5f, 0.25f), shifted(scene, s, 0.5f, 0.75f),
                                shifted(scene, s, 0.25f, 0.5f), shifted(scene, s, 0.75f, 0.5f)});
    SceneDescription no_planes = scene;
    std::erase_if(no_planes.objects, [](const Object& object) { return std::holds_alternative<Plane>(object.shape); });
    const SceneArrays arrays = flatten(scene, s, 1);
    Rays rays;
    const CameraRecord camera = make_job(arrays, scene.camera, s, FrameOptions{64, 48, {0, 0, 0, 0}, 1, 32}).camera;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const float sx = (static_cast<float>(x) + 0.5f - 32) * camera.pixel,
                        sy = (24 - (static_cast<float>(y) + 0.5f)) * camera.pixel;
            glm::dvec3 d;
            for (int axis = 0; axis < 3; ++axis)
                d[axis] = static_cast<double>(camera.forward[axis] + (camera.right[axis] * sx + camera.up[axis] * sy));
            rays.add({camera.org[0], camera.org[1], camera.org[2]}, d);
        }
    const Hits hits = ask(fastest(), view(arrays), rays, Query::closest);
    for (const bool planes : {true, false}) {
        s.anti_aliasing.planes = planes;
        const Film cross = film_of(scene, s);
        int several = 0, single = 0;
        for (std::size_t i = 0; i < hits.slot.size(); ++i) {
            const bool hit = hits.slot[i] >= 0,
                       on_plane = hit && static_cast<std::uint32_t>(hits.slot[i]) >= arrays.first_slot[6];
            const bool sampled = hit && (planes || !on_plane);
            ++(sampled ? several : single);
            for (std::size_t c = 0; c < 3; ++c)
                REQUIRE(bits_of(cross.rgb[c][i]) == bits_of((sampled ? averaged : centre).rgb[c][i]));
        }
        CHECK(several > 500);
        CHECK((single > 100 || planes));
    }
}

TEST_CASE("grid N is the mean of N x N pictures") {
    RenderSettings s;
    s.depth = 3;
    for (const int n : {1, 2, 4}) {
        s.anti_aliasing = {AntiAliasMode::grid, n, 0.25, true};
        std::vector<Film> films;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                films.push_back(shifted(everything(), s, (static_cast<float>(i) + 0.5f) / static_cast<float>(n),
                                        (static_cast<float>(j) + 0.5f) / static_cast<float>(n)));
        CHECK(film_difference(film_of(everything(), s), mean(films)) == "");
    }
}

TEST_CASE("edge is the grid where an edge crosses, the mean of centre and corners beside it, and one sample elsewhere") {
    RenderSettings s, grid, single;
    s.anti_aliasing = {AntiAliasMode::edge, 3, 0.25, true};
    grid.anti_aliasing = {AntiAliasMode::grid, 3, 0.25, true};
    const Frame edge = frame_of(everything(), s);
    const Film full = film_of(everything(), grid), one = film_of(everything(), single);
    const auto sixth = [&](float x, float y) { return shifted(everything(), single, x / 6, y / 6); };
    const Film beside = mean({one, sixth(1, 1), sixth(5, 1), sixth(1, 5), sixth(5, 5)});
    int refined = 0, near = 0, kept = 0, missed = 0;
    const auto value = [](const Film& film, std::size_t i) { return glm::vec3(film.rgb[0][i], film.rgb[1][i], film.rgb[2][i]); };
    for (std::size_t i = 0; i < full.rgb[0].size(); ++i) {
        const glm::vec3 v = value(edge.film, i);
        const auto is = [&](const Film& film) { return glm::length(v - value(film, i)) < 2e-6f; }; // sums in another order
        REQUIRE((is(full) || is(beside) || v == value(one, i)));
        refined += is(full) && !is(beside) && !is(one);
        near += is(beside) && !is(full) && !is(one);
        kept += v == value(one, i) && !is(full) && !is(beside);
        // a strong step to the right neighbour must have been seen
        if ((i + 1) % 64 != 0 && glm::length(value(one, i) - value(one, i + 1)) > 0.3f) missed += !is(full) && !is(beside);
    }
    CHECK(refined > 100);
    CHECK(near > 100);
    CHECK(kept > 100);
    CHECK(missed == 0);
    CHECK(rays_of(edge, RayKind::offset) >= 9u * static_cast<unsigned>(refined) + 4u * static_cast<unsigned>(near));
}

TEST_CASE("near clips camera rays only") {
    SceneDescription scene = everything();
    scene.camera.near = 4.5;
    const Film clipped = film_of(scene, RenderSettings{});
    CHECK(film_difference(clipped, film_of(everything(), RenderSettings{})) != "");
    scene.camera.near = 1e-3;
    CHECK(film_difference(film_of(scene, RenderSettings{}), film_of(everything(), RenderSettings{})) == "");
}

TEST_CASE("a scene is charged only for what it uses") {
    const SceneDescription full = everything();
    SceneDescription dark = full;
    std::erase_if(dark.lights, [](const Light& light) { return !std::holds_alternative<AmbientLight>(light); });
    const Frame unlit = frame_of(dark, RenderSettings{});
    CHECK(rays_of(unlit, RayKind::shadow) == 0);
    CHECK(rays_of(unlit, RayKind::reflection) > 0);
    CHECK(scratch_of(dark, RenderSettings{}) < scratch_of(full, RenderSettings{}));

    SceneDescription opaque = full, matte = matte_scene();
    for (Object& object : opaque.objects) object.material.transmissive = glm::dvec3(0);
    const Frame solid = frame_of(opaque, RenderSettings{});
    CHECK(rays_of(solid, RayKind::refraction) == 0);
    CHECK(rays_of(solid, RayKind::reflection) > 0);
    CHECK(scratch_of(opaque, RenderSettings{}) < scratch_of(full, RenderSettings{}));
    CHECK(scratch_of(matte, RenderSettings{}) < scratch_of(opaque, RenderSettings{}));
    CHECK(rays_of(frame_of(matte, RenderSettings{}), RayKind::reflection) == 0);
    CHECK(rays_of(frame_of(full, RenderSettings{}), RayKind::offset) == 0);
}

TEST_CASE("each kind of ray goes through the batch entry, many at a time") {
    RenderSettings s;
    s.anti_aliasing = {AntiAliasMode::cross, 4, 1.0 / 3, true};
    for (const KernelTable* kernels : balanced_kernels()) {
        const Frame frame = shoot(*kernels, everything(), Shot{{64, 48, {0, 0, 0, 0}, 1, 32}, s});
        for (const RayKindStats& kind : frame.stats.tiles.kinds) {
            CHECK(kind.batches > 0);
            CHECK(kind.rays > kind.batches * 8);
            CHECK(kind.first_active >= kind.rays);
            CHECK(kind.first_lanes >= kind.first_active);
            CHECK(kind.last_lanes >= kind.last_active);
        }
        CHECK(frame.stats.tiles.kinds[static_cast<int>(RayKind::primary)].rays == 64 * 48);
    }
}
