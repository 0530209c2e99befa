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

/// "fast", "balanced", "precise", "reference"
[[nodiscard]] const char* name_of(Precision precision);
/// Throws Error, ExitCode::usage.
[[nodiscard]] Precision precision_named(std::string_view name);

/// Whether pictures of the two are the same bytes: `precise` computes what `reference` does.
[[nodiscard]] bool same_numbers(Precision a, Precision b);

/// The fastest one whose kernels of that precision this build holds and this CPU runs; "" where there is none, which happens to
/// `fast` and `precise` only.
[[nodiscard]] std::string_view best_isa(Precision precision = Precision::balanced);

/// Every table that this build holds and this CPU runs, or those of one precision; slowest instruction set first.
[[nodiscard]] std::vector<const KernelTable*> usable_kernels();
[[nodiscard]] std::vector<const KernelTable*> usable_kernels(Precision precision);

/// The fastest kernels that compute the numbers of `reference`: `precise` where there is one.
[[nodiscard]] const KernelTable& truth_kernels();

/// The kernels of `isa`, a name as above or "auto". `reference` is scalar only, `precise` all but scalar, `fast` avx2 and avx512
/// only: other pairs are usage errors. Throws Error: ExitCode::usage for those and for a name that does not exist, ExitCode::isa
/// where the CPU or this build lacks it. The table is static.
[[nodiscard]] const KernelTable& find_kernels(std::string_view isa, Precision precision);

} // namespace lanecast
