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
// spawn.cpp
void test_self_shadow(const Block& block, Tally& tally);
void test_self_reflection(const Block& block, Tally& tally);
// quadrics.cpp
void test_far_sphere(const Block& block, Tally& tally);
void test_far_sphere_beside(const Block& block, Tally& tally);
void test_far_sphere_rounding(const Block& block, Tally& tally);
void test_huge_sphere(const Block& block, Tally& tally);
void test_cylinder(const Block& block, Tally& tally);
void test_cylinder_rounding(const Block& block, Tally& tally);
void test_cylinder_axis(const Block& block, Tally& tally);
// triangles.cpp
void test_triangle_t(const Block& block, Tally& tally);
void test_needle_t(const Block& block, Tally& tally);
// frames.cpp
void test_scaled_scene(const Block& block, Tally& tally);
// canaries.cpp
void test_canaries(const Block& block, Tally& tally);

} // namespace lanecast::selftest
