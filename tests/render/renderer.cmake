# Whole-program tests of the renderer, through the kernel tables of every ISA.
lanecast_test(test_traversal LABELS unit determinism
  SOURCES
  render/traversal_test.cpp
  scene/geometry_support.cpp)
lanecast_test(test_determinism LABELS determinism
  SOURCES
  render/determinism_test.cpp
  render/render_support.cpp
  scene/geometry_support.cpp)
lanecast_test(test_fast LABELS unit determinism
  SOURCES
  render/fast_test.cpp
  render/render_support.cpp
  scene/geometry_support.cpp)
lanecast_test(test_whitted LABELS unit
  SOURCES
  render/whitted_test.cpp
  render/whitted_oracle.cpp
  render/render_support.cpp
  scene/geometry_support.cpp)
lanecast_test(test_switches LABELS unit
  SOURCES
  render/switches_test.cpp
  render/render_support.cpp
  scene/geometry_support.cpp)
foreach(test test_traversal test_determinism test_fast test_switches) # scenes and rays of `lanecast selftest`
  target_link_libraries(${test} PRIVATE lanecast_selftest)
endforeach()
# What adaptive work promises: rays and errors are counted, not timed.
lanecast_test(test_adaptive LABELS unit
  SOURCES
  render/cutoff_test.cpp
  render/edge_test.cpp
  render/soft_shadow_test.cpp
  render/render_support.cpp
  scene/geometry_support.cpp)
