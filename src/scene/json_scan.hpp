#pragma once
// A JSON tokenizer that knows offsets and says what it expected. Slow path only: see source_map.hpp.

#include "scene/source_map.hpp"

namespace lanecast {

struct JsonScan {
    std::vector<SourceSpan> found; ///< of the wanted nodes that were reached
    std::size_t end = 0;           ///< one past the root value, or where the scan stopped
    std::optional<SyntaxFault> fault;
};

/// Walks the root value, iteratively. `wanted` ascends.
[[nodiscard]] JsonScan scan_json(std::string_view text, const std::vector<NodeId>& wanted);

/// One step of a JSON pointer, with ~ and / escaped, made printable and cut when long.
[[nodiscard]] std::string pointer_step(std::string_view key);

} // namespace lanecast
