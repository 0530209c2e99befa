# lanecast_isa_test(<name> LABELS <label>... SOURCES <file>...)
# One source, compiled for every ISA of the build with its kernels' flags and LANECAST_ISA=<namespace>, each into an executable of its own, so that
# nothing is shared. Tests are named <name>_<namespace>; those the CPU cannot run say so and pass.
add_executable(run_on_isa run_on_isa.cpp)
target_link_libraries(run_on_isa PRIVATE lanecast::lanecast lanecast_flags)

function(lanecast_isa_test name)
  cmake_parse_arguments(arg "" "" "LABELS;SOURCES" ${ARGN})
  foreach(isa IN LISTS lanecast_isas)
    set(target ${name}_${isa})
    list(GET lanecast_isa_${isa} 0 isa_name)
    add_executable(${target} ${arg_SOURCES} $<TARGET_OBJECTS:test_main>)
    target_link_libraries(${target} PRIVATE doctest::doctest)
    lanecast_isa_flags(${target} ${isa})
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/tests)
    add_test(NAME ${target} COMMAND run_on_isa ${isa_name} $<TARGET_FILE:${target}>)
    set_tests_properties(${target} PROPERTIES LABELS "${arg_LABELS}")
  endforeach()
endfunction()
