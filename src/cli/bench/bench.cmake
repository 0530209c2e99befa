# `lanecast bench`. Embree is an optional peer of the program, never of the library: 4 if it is there, else 3.
target_sources(lanecast PRIVATE
  cli/bench/agreement.cpp
  cli/bench/bench.cpp
  cli/bench/bench_mesh.cpp
  cli/bench/calls.cpp
  cli/bench/frames.cpp
  cli/bench/measure.cpp
  cli/bench/ours.cpp
  cli/bench/procedural.cpp
  cli/bench/ray_sets.cpp
  cli/bench/report_json.cpp
  cli/bench/report_svg.cpp
  cli/bench/report_text.cpp
)
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 QUIET)
endif()
if(embree_FOUND)
  target_sources(lanecast PRIVATE cli/bench/embree.cpp)
  target_link_libraries(lanecast PRIVATE embree)
  set_source_files_properties(cli/bench/embree.cpp PROPERTIES COMPILE_DEFINITIONS LANECAST_EMBREE=${EMBREE_VERSION_MAJOR})
else()
  target_sources(lanecast PRIVATE cli/bench/no_embree.cpp)
endif()
set_source_files_properties(cli/bench/calls.cpp cli/bench/embree.cpp cli/bench/measure.cpp cli/bench/ours.cpp PROPERTIES COMPILE_OPTIONS -O3)
