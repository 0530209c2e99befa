#pragma once
// Which instruction sets this build holds, which of them this CPU runs, and the table of one of them.

#include "render/kernel_table.hpp"
#include "scene/render_settings.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

struct IsaInfo {
    std::string name;       ///< "scalar", "sse4.2", "avx2", "avx512"
    int width = 0;          ///< rays per vector; 0 when the build lacks it
    bool compiled = false;  ///< in this build
    bool supported = false; ///< by this CPU and its operating system
};

/// Every instruction set Lanecast knows, slowest first.
[[nodiscard]] std::vector<IsaInfo> known_isas();

/// The fastest one that this build holds and this CPU runs.
[[nodiscard]] std::string_view best_isa();

/// The kernels of `isa`, a name as above or "auto". Precision::reference is scalar, so there "auto" and "scalar" are the
/// same and any other name is a usage error. Throws Error: ExitCode::usage for a name that does not exist, ExitCode::isa where
/// the CPU or this build lacks it. The table is static.
[[nodiscard]] const KernelTable& find_kernels(std::string_view isa, Precision precision);

} // namespace lanecast
