# What the numbers rest on, tested in the compiler and not in our code: each subject once with the project's flags, which must
# be right, and once with none of them, to see whether they are still needed.
lanecast_isa_test(test_canaries LABELS unit SOURCES canaries/canaries_test.cpp ../src/cli/selftest/canary_subjects.cpp)
foreach(isa IN LISTS lanecast_isas)
  set(flags ${lanecast_isa_${isa}})
  list(REMOVE_AT flags 0 1)
  add_library(canary_subjects_${isa} OBJECT ../src/cli/selftest/canary_subjects.cpp)
  target_compile_options(canary_subjects_${isa} PRIVATE -O2 -march=x86-64 ${flags})
  target_compile_definitions(canary_subjects_${isa} PRIVATE LANECAST_CANARY=unflagged)
  target_include_directories(canary_subjects_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/src)
  target_sources(test_canaries_${isa} PRIVATE $<TARGET_OBJECTS:canary_subjects_${isa}>)
endforeach()
