#pragma once
// The functions of the cases; what each is about stands in the list, cases.cpp.

#include "cli/selftest/case.hpp"

namespace lanecast::selftest {

// watertight.cpp
void test_leaks_at_edges(const Block& block, Tally& tally);
void test_leaks_at_vertices(const Block& block, Tally& tally);
void test_tree_leaks_at_edges(const Block& block, Tally& tally);
void test_tree_leaks_at_vertices(const Block& block, Tally& tally);
// agreement.cpp
void test_tree_is_brute_force(const Block& block, Tally& tally);
void test_tree_from_afar(const Block& block, Tally& tally);
void test_lanes(const Block& block, Tally& tally);
void test_lanes_from_afar(const Block& block, Tally& tally);
// motions.cpp
void test_translated(const Block& block, Tally& tally);
void test_turned(const Block& block, Tally& tally);
// contact.cpp
void test_contact(const Block& block, Tally& tally);
// transforms.cpp
void test_object_space(const Block& block, Tally& tally);
void test_normals(const Block& block, Tally& tally);
// torture.cpp
void test_torture(const Block& block, Tally& tally);
void test_bad_rays(const Block& block, Tally& tally);
void test_bad_ray_time(const Block& block, Tally& tally);
// optics.cpp
void test_furnace(const Block& block, Tally& tally);
void test_glass_furnace(const Block& block, Tally& tally);
void test_mirror_cube(const Block& block, Tally& tally);
void test_fresnel(const Block& block, Tally& tally);
// files.cpp
void test_half_file(const Block& block, Tally& tally);
// spawn.cpp
void test_self_shadow(const Block& block, Tally& tally);
void test_self_reflection(const Block& block, Tally& tally);
// quadrics.cpp
void test_far_sphere(const Block& block, Tally& tally);
void test_far_sphere_beside(const Block& block, Tally& tally);
void test_far_sphere_rounding(const Block& block, Tally& tally);
void test_huge_sphere(const Block& block, Tally& tally);
void test_cylinder(const Block& block, Tally& tally);
void test_cylinder_axis(const Block& block, Tally& tally);
// triangles.cpp
void test_triangle_t(const Block& block, Tally& tally);
void test_needle_t(const Block& block, Tally& tally);
// frames.cpp
void test_threads(const Block& block, Tally& tally);
void test_preset_order(const Block& block, Tally& tally);
void test_scaled_scene(const Block& block, Tally& tally);
// canaries.cpp
void test_canaries(const Block& block, Tally& tally);

} // namespace lanecast::selftest
