# `lanecast bench`, and the optional peer Embree: 4 if it is there, else 3, in a module that `bench` and `selftest --peer` load.
# Not installed.
target_sources(lanecast PRIVATE
  cli/embree_module.cpp
  cli/bench/agreement.cpp
  cli/bench/bench.cpp
  cli/bench/bench_mesh.cpp
  cli/bench/builds.cpp
  cli/bench/calls.cpp
  cli/bench/drawing.cpp
  cli/bench/features.cpp
  cli/bench/frames.cpp
  cli/bench/measure.cpp
  cli/bench/ours.cpp
  cli/bench/peer.cpp
  cli/bench/procedural.cpp
  cli/bench/ray_sets.cpp
  cli/bench/report_json.cpp
  cli/bench/report_plot.cpp
  cli/bench/report_text.cpp
)
target_link_libraries(lanecast PRIVATE ${CMAKE_DL_LIBS})
set_source_files_properties(cli/bench/calls.cpp cli/bench/measure.cpp cli/bench/ours.cpp PROPERTIES COMPILE_OPTIONS -O3)

option(LANECAST_EMBREE "Embree as the peer of `lanecast bench` and `selftest`, where it is found" ON)
if(LANECAST_EMBREE)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 QUIET)
  endif()
endif()
if(LANECAST_EMBREE AND embree_FOUND)
  add_library(lanecast_embree MODULE
    cli/bench/embree.cpp
    cli/bench/embree_build.cpp
    cli/selftest/embree_peer.cpp)
  target_compile_definitions(lanecast_embree PRIVATE LANECAST_EMBREE_MAJOR=${EMBREE_VERSION_MAJOR})
  target_include_directories(lanecast_embree PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(lanecast_embree PRIVATE embree lanecast_flags glm::glm)
  set_target_properties(lanecast_embree PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lanecast lanecast_embree)
endif()
