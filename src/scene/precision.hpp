#pragma once
// BOUNDARY: how numbers are computed, never what is computed.

#include <cstdint>

namespace lanecast {

/// `fast`: float with fused multiply-add, where the ISA has it. `balanced`: float, IEEE's single operations only, the same bytes
/// on every ISA. `precise`: double, the reference's bytes. `reference`: the scalar program in double, the truth that the others
/// are measured against.
enum class Precision : std::uint32_t { fast, balanced, precise, reference };

} // namespace lanecast
