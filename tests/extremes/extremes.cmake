# The cases of `lanecast selftest` at a size that takes about a minute in all, and what runs them.
lanecast_test(test_extremes LABELS extremes SOURCES extremes/extremes_test.cpp ../src/cli/print.cpp)
lanecast_test(test_selftest LABELS unit SOURCES extremes/selftest_test.cpp)
foreach(test test_extremes test_selftest)
  target_link_libraries(${test} PRIVATE lanecast_selftest)
endforeach()
lanecast_program_test(test_selftest_command LABELS errors unit SOURCES extremes/selftest_command_test.cpp)
target_compile_definitions(test_selftest_command PRIVATE LANECAST_PROGRAM_FILE="$<TARGET_FILE:lanecast>")
