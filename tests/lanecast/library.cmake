# The public interface.
lanecast_test(test_library LABELS unit determinism errors
  SOURCES
  lanecast/library_test.cpp
  lanecast/library_build_test.cpp
  scene/geometry_support.cpp)
