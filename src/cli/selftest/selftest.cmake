# `lanecast selftest`. Its cases are a library of their own, for tests/extremes/ runs the same ones.
add_library(lanecast_selftest STATIC
  cli/selftest/agreement.cpp
  cli/selftest/caller.cpp
  cli/selftest/canaries.cpp
  cli/selftest/case.cpp
  cli/selftest/cases.cpp
  cli/selftest/contact.cpp
  cli/selftest/files.cpp
  cli/selftest/frames.cpp
  cli/selftest/leaf_tree.cpp
  cli/selftest/meshes.cpp
  cli/selftest/motions.cpp
  cli/selftest/objects.cpp
  cli/selftest/optics.cpp
  cli/selftest/oracle.cpp
  cli/selftest/peer_cases.cpp
  cli/selftest/picture.cpp
  cli/selftest/plan.cpp
  cli/selftest/progress.cpp
  cli/selftest/quadrics.cpp
  cli/selftest/rays.cpp
  cli/selftest/report.cpp
  cli/selftest/run.cpp
  cli/selftest/scenes.cpp
  cli/selftest/spawn.cpp
  cli/selftest/state.cpp
  cli/selftest/torture.cpp
  cli/selftest/transforms.cpp
  cli/selftest/triangles.cpp
  cli/selftest/watertight.cpp
  cli/selftest/wiggle.cpp
)
target_link_libraries(lanecast_selftest PRIVATE lanecast::lanecast lanecast_flags)
target_include_directories(lanecast_selftest PRIVATE ${CMAKE_BINARY_DIR}/generated) # kernel_list.inc
# What the compiler must do, compiled with the flags of each set of kernels.
foreach(isa IN LISTS lanecast_isas lanecast_fast_isas lanecast_precise_isas)
  add_library(lanecast_canaries_${isa} OBJECT cli/selftest/canary_subjects.cpp)
  lanecast_isa_flags(lanecast_canaries_${isa} ${isa})
  target_include_directories(lanecast_canaries_${isa} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(lanecast_canaries_${isa} PRIVATE LANECAST_CANARY=canary_${isa})
  target_sources(lanecast_selftest PRIVATE $<TARGET_OBJECTS:lanecast_canaries_${isa}>)
endforeach()
target_sources(lanecast PRIVATE
  cli/selftest/peer.cpp
  cli/selftest/peer_report.cpp
  cli/selftest/selftest.cpp
)
target_link_libraries(lanecast PRIVATE lanecast_selftest)
