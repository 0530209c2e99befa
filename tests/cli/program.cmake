# Tests of the program, from outside: tests/cli/run_program.hpp.

# lanecast_program_test(<name> LABELS <label>... SOURCES <file>...): runs the program itself.
add_library(run_program OBJECT cli/run_program.cpp)
target_include_directories(run_program PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(run_program PRIVATE lanecast_flags)
target_compile_definitions(run_program PRIVATE
  LANECAST_PROGRAM="$<TARGET_FILE:lanecast>" LANECAST_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
function(lanecast_program_test name)
  lanecast_test(${name} ${ARGN})
  target_sources(${name} PRIVATE $<TARGET_OBJECTS:run_program>)
  target_link_libraries(${name} PRIVATE util) # openpty, before glibc 2.34
  add_dependencies(${name} lanecast)
endfunction()
lanecast_program_test(test_exit_codes LABELS errors unit SOURCES cli/exit_codes_test.cpp)
lanecast_program_test(test_progress LABELS unit SOURCES cli/progress_test.cpp)
lanecast_program_test(test_render_command LABELS unit determinism SOURCES cli/render_command_test.cpp)
lanecast_program_test(test_info_command LABELS unit golden SOURCES cli/info_test.cpp)
lanecast_program_test(test_pick_command LABELS unit golden SOURCES cli/pick_command_test.cpp)
lanecast_program_test(test_bench_command LABELS unit errors SOURCES cli/bench_command_test.cpp)
