#pragma once
// What a call costs beside the tracing: streams of 1 to 65536 rays through the library and through the kernels' own entry.

#include "cli/bench/bench_mesh.hpp"

#include <string>

namespace lanecast::bench {

/// Primary rays of the mesh's view, and an empty scene that they all miss. A table.
[[nodiscard]] std::string measure_calls(const BenchMesh& mesh, const std::string& isa, int repetitions);

} // namespace lanecast::bench
