# `lanecast measure` and `lanecast render --max-error`.
lanecast_test(test_measure LABELS unit
  SOURCES
  cli/measure_test.cpp
  render/render_support.cpp
  scene/geometry_support.cpp
  ../src/cli/interrupt.cpp
  ../src/cli/measure/experiment.cpp
  ../src/cli/measure/knobs.cpp
  ../src/cli/measure/ray_errors.cpp
  ../src/cli/measure/sampling.cpp
  ../src/cli/measure/trial.cpp
  ../src/cli/measure/walk.cpp
  ../src/cli/parse_value.cpp
  ../src/cli/print.cpp
  ../src/cli/settings_options.cpp)
target_link_libraries(test_measure PRIVATE CLI11::CLI11)
lanecast_program_test(test_measure_command LABELS unit errors SOURCES cli/measure_command_test.cpp)
target_link_libraries(test_measure_command PRIVATE nlohmann_json::nlohmann_json)
lanecast_program_test(test_budget_command LABELS unit errors determinism SOURCES cli/budget_command_test.cpp)
