# lanecast_fuzzer(<name> SOURCES <file>...)
# A libFuzzer target: LLVMFuzzerTestOneInput in one of the sources. Built by the fuzz preset only.
function(lanecast_fuzzer name)
  if(NOT LANECAST_FUZZ)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "SOURCES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE lanecast::lanecast lanecast_flags)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
endfunction()

# Everything that reads a user's file; tests/fuzz/run runs them.
foreach(reader scene obj ply)
  lanecast_fuzzer(fuzz_${reader} SOURCES fuzz/fuzz_${reader}.cpp)
endforeach()
