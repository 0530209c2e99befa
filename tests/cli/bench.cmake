# What `lanecast bench` measures with.
lanecast_test(test_bench LABELS unit
  SOURCES
  cli/bench_test.cpp
  ../src/cli/bench/agreement.cpp
  ../src/cli/bench/bench_mesh.cpp
  ../src/cli/bench/drawing.cpp
  ../src/cli/bench/measure.cpp
  ../src/cli/bench/procedural.cpp
  ../src/cli/bench/ray_sets.cpp
  ../src/cli/bench/report_json.cpp
  ../src/cli/bench/report_plot.cpp
  ../src/cli/bench/report_text.cpp
  ../src/cli/print.cpp)
