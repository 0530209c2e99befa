# Tests of the SIMD kernels, one executable per ISA.
lanecast_isa_test(test_simd LABELS unit determinism SOURCES kernels/simd_test.cpp)
lanecast_isa_test(test_pow LABELS unit determinism SOURCES kernels/pow_test.cpp)
lanecast_isa_test(test_triangle LABELS unit SOURCES kernels/triangle_test.cpp)
lanecast_isa_test(test_candidates LABELS unit determinism SOURCES kernels/candidates_test.cpp)
lanecast_isa_test(test_quadric LABELS unit SOURCES kernels/quadric_test.cpp)
lanecast_isa_test(test_optics LABELS unit SOURCES kernels/optics_test.cpp)
lanecast_isa_test(test_cone LABELS unit SOURCES kernels/cone_test.cpp)
lanecast_isa_test(test_open_body LABELS unit SOURCES kernels/open_body_test.cpp)
lanecast_isa_test(test_spawn LABELS unit SOURCES kernels/spawn_test.cpp)
foreach(isa IN LISTS lanecast_isas) # scenes come from `flatten`
  target_link_libraries(test_open_body_${isa} PRIVATE lanecast::lanecast)
  target_link_libraries(test_spawn_${isa} PRIVATE lanecast::lanecast)
endforeach()
