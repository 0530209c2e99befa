#include "cli/selftest/cases.hpp"

namespace lanecast::selftest {

const std::vector<Case>& all_cases() {
    using enum PrimitiveKind;
    constexpr unsigned round = every_placing & ~only(Placing::stretched);
    constexpr unsigned centred = round & ~only(Placing::translated);
    constexpr unsigned here_and_there = only(Placing::plain) | only(Placing::translated);
    constexpr Scope anything{every_primitive, every_placing, every_path, true};
    constexpr Scope pictures{every_primitive, every_placing, only(Path::batch), true}; // the renderer makes its own batches
    constexpr Scope convex{every_primitive & ~only(open_cone), every_placing, only(Path::batch), true};
    constexpr Scope meshes{only(triangle), every_placing, every_path, false},
        mesh_trees{only(triangle), every_placing, every_path, true};
    constexpr Scope round_triangles{only(triangle), round, every_path, true};
    constexpr Scope spheres{only(sphere), centred, every_path, false};
    constexpr Scope spheres_beside{only(sphere), only(Placing::translated), every_path, false};
    constexpr Scope cylinders{only(cylinder), round, every_path, false};
    constexpr Scope bodies{only(ellipsoid) | only(cylinder), here_and_there | only(Placing::mirrored), only(Path::batch), false};
    constexpr Scope kernels_only{};
    // Rays of the minute's size: what its time allows, most to what has failed in programs of this kind.
    // clang-format off
    static const std::vector<Case> cases{
        {"N1", "edges", "no ray leaves a closed mesh through an edge",
         {}, test_leaks_at_edges, meshes, 5'000'000},
        {"N1", "vertices", "no ray leaves a closed mesh through a vertex",
         {}, test_leaks_at_vertices, meshes, 5'000'000},
        {"N2", "edges", "nor through an edge by way of the tree",
         {}, test_tree_leaks_at_edges, mesh_trees, 5'000'000},
        {"N2", "vertices", "nor through a vertex by way of the tree",
         {}, test_tree_leaks_at_vertices, mesh_trees, 5'000'000},
        {"N3", "near", "the tree finds what testing every primitive finds",
         {}, test_tree_is_brute_force, anything, 5'000'000},
        {"N3", "far", "for rays from up to 1e6 scenes away, too",
         {}, test_tree_from_afar, anything, 5'000'000},
        {"N4", "near", "the same bits in any company, on every instruction set",
         {}, test_lanes, anything, 4'000'000},
        {"N4", "far", "for rays from up to 1e6 scenes away, too",
         {}, test_lanes_from_afar, anything, 4'000'000},
        {"N5", "", "a scene 2^k as large looks the same",
         {}, test_scaled_scene, pictures, 2'000'000, 16384},
        {"N6", "", "a scene moved by steps of the grid is the same scene",
         {.worst = 4, .unit = "u |T|"}, test_translated, {every_primitive, only(Placing::plain), every_path, false}, 2'000'000},
        {"N7", "", "turned by quarters, mirrored: the same hits, t to 4 ulp",
         {}, test_turned, {every_primitive, round, every_path, false}, 2'000'000},
        {"N8", "shadows", "no convex body shadows itself",
         {}, test_self_shadow, convex, 5'000'000},
        {"N8", "reflections", "no convex body mirrors itself",
         {}, test_self_reflection, convex, 2'000'000, 16384},
        {"N9", "", "what lies four offsets above a surface is seen",
         {}, test_contact, {only(triangle) | only(sphere) | only(cylinder) | only(plane), here_and_there, 1, false}, 2'000'000, 16384},
        {"N10", "far", "spheres 3 to 1e7 radii away are met where they are",
         {.worst = 4, .unit = "ulp"}, test_far_sphere, spheres, 2'000'000},
        {"N10", "beside", "and not met beside",
         {.failure_rate = 1e-5}, test_far_sphere_beside, spheres, 2'000'000},
        {"N10", "huge", "from a height of 1 over radii to 1e7",
         {.worst = 128, .unit = "ulp"}, test_huge_sphere, spheres, 2'000'000},
        {"N10", "far, off centre", "far spheres that are not at the centre of the scene",
         {.worst = 4, .unit = "ulp"}, test_far_sphere, spheres_beside, 2'000'000},
        {"N10", "far, rounding", "what is missed there is missed by the ray's own rounding",
         {}, test_far_sphere_rounding, spheres_beside, 2'000'000},
        {"N10", "huge, off centre", "huge spheres that are not at the centre of the scene",
         {.worst = 128, .unit = "ulp"}, test_huge_sphere, spheres_beside, 2'000'000},
        {"N11", "sides", "cylinders, radius / height 1e-3 to 1e3, are met where they are",
         {.p99 = 4, .unit = "ulp"}, test_cylinder, cylinders, 2'000'000},
        {"N11", "axis", "along the axis the caps are met",
         {.p99 = 4, .unit = "ulp"}, test_cylinder_axis, cylinders, 2'000'000},
        {"N12", "triangles", "t of triangles, within their depth",
         {.p99 = 4, .unit = "ulp"}, test_triangle_t, round_triangles, 2'000'000},
        {"N12", "needles", "t of needles of 1:1e4, within their depth",
         {.p99 = 500, .unit = "ulp"}, test_needle_t, round_triangles, 2'000'000},
        {"N13", "points", "points on transformed bodies, in units of the body, up to 1e6 sizes off",
         {.worst = 1e-6}, test_object_space, bodies, 2'000'000},
        {"N13", "normals", "normals there, at conditions up to 10",
         {.worst = 1e-6, .unit = "rad"}, test_normals, bodies, 2'000'000},
        {"N14", "", "any input gives a message or a picture without a NaN",
         {}, test_torture, kernels_only, 500'000, 16384},
        {"N15", "", "rays that are none hit nothing and change no other",
         {}, test_bad_rays, {every_primitive, every_placing, every_path, false}, 2'000'000},
        {"N15", "time", "and cost no more than 1.2 times what good ones do",
         {.median = 1.2}, test_bad_ray_time, {every_primitive, 1, only(Path::batch) | only(Path::mixed), false}, 500'000, 16384, 0.07}, // each ray is traced 14 times
        {"N16", "furnace", "white surfaces and mirrors in a white room are white",
         {.worst = 4, .unit = "ulp"}, test_furnace, pictures, 2'000'000, 32768},
        {"N16", "glass", "glass there gives no light of its own",
         {}, test_glass_furnace, pictures, 2'000'000, 32768},
        {"N17", "", "a thousand mirrorings in a cube",
         {.failure_rate = 0.005, .mean = 2e-5}, test_mirror_cube, {only(triangle) | only(plane), 1, 1, false}, 1'000'000, 65536, 0.1},
        {"N18", "", "the share that glass mirrors, at any angle and past the critical one",
         {}, test_fresnel, kernels_only, 1'000'000, 16384},
        {"N19", "", "no infinity in a half file, and the count of what was cut",
         {}, test_half_file, kernels_only, 500'000},
        {"N20", "", "the same picture by any threads, tiles and crop",
         {}, test_threads, pictures, 2'000'000, 32768},
        {"N21", "", "compiler and processor do what everything rests on",
         {}, test_canaries, kernels_only, 1'000'000},
        {"N23", "", "fast is not nearer to the reference than balanced",
         {.listed = true}, test_preset_order, pictures, 2'000'000},
    };
    // clang-format on
    return cases;
}

} // namespace lanecast::selftest
