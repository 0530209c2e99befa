# `lanecast measure`, and what `lanecast render --max-error` chooses by.
target_sources(lanecast PRIVATE
  cli/measure/budget.cpp
  cli/measure/budget_options.cpp
  cli/measure/experiment.cpp
  cli/measure/knobs.cpp
  cli/measure/measure.cpp
  cli/measure/ray_errors.cpp
  cli/measure/report_html.cpp
  cli/measure/report_json.cpp
  cli/measure/report_plot.cpp
  cli/measure/report_text.cpp
  cli/measure/sampling.cpp
  cli/measure/trial.cpp
  cli/measure/walk.cpp
)
