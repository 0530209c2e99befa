# The seed tracer: a second opinion on the picture, and the program behind the reference pictures.
set(seed_tracer golden/seed_tracer.cpp golden/seed_scene.cpp golden/seed_intersect.cpp golden/seed_light.cpp)
lanecast_test(test_seed_tracer LABELS golden SOURCES golden/seed_tracer_test.cpp ${seed_tracer})
lanecast_test(test_reference_pictures LABELS golden SOURCES golden/reference_pictures_test.cpp ${seed_tracer})
# The Standard Procedural Databases, generated once, their rays counted.
if(LANECAST_PYTHON)
  add_test(NAME spd_scenes COMMAND ${LANECAST_PYTHON} ${CMAKE_SOURCE_DIR}/tools/spd/generate all -o ${CMAKE_BINARY_DIR}/spd)
  set_tests_properties(spd_scenes PROPERTIES LABELS golden FIXTURES_SETUP spd)
  lanecast_test(test_spd_counts LABELS golden SOURCES golden/spd_counts_test.cpp golden/spd_rays.cpp)
  target_compile_definitions(test_spd_counts PRIVATE LANECAST_SPD_DIR="${CMAKE_BINARY_DIR}/spd")
  set_tests_properties(test_spd_counts PROPERTIES FIXTURES_REQUIRED spd)
  add_executable(spd_times EXCLUDE_FROM_ALL golden/spd_times.cpp) # what docs/spd.md publishes
  target_link_libraries(spd_times PRIVATE lanecast::lanecast lanecast_flags)
  target_compile_definitions(spd_times PRIVATE LANECAST_SPD_DIR="${CMAKE_BINARY_DIR}/spd")
endif()
