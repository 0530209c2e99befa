#pragma once
// Where things are in a JSON text. nlohmann 3.11 gives no positions, so when there is something to report, the text is
// scanned again: the k-th value or key that the scan meets is node k of the JsonDocument.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/json_document.hpp"

namespace lanecast {

struct SourceSpan {
    std::size_t begin = 0; ///< byte offsets
    std::size_t end = 0;
};

struct SyntaxFault {
    std::size_t offset = 0;
    std::string place;   ///< JSON pointer of the value the fault is in; set where the fault is in a value, not in the grammar
    std::string message; ///< what was expected and what was found
};

/// What is wrong with a text that `parse_json` refused.
[[nodiscard]] SyntaxFault find_syntax_fault(std::string_view text);

/// Spans of the nodes `ids`, which ascend. A list's or object's span is its opening bracket.
[[nodiscard]] std::vector<SourceSpan> locate_nodes(std::string_view text, const std::vector<NodeId>& ids);

/// The first byte after the root value that is not white space.
[[nodiscard]] std::size_t find_trailing_text(std::string_view text);

/// JSON pointer of a node: /objects/3/radius; for a key, that of its value.
[[nodiscard]] std::string pointer_to(const JsonDocument& document, NodeId id);

/// The value at a pointer; no_node where there is none.
[[nodiscard]] NodeId node_at(const JsonDocument& document, std::string_view pointer);

} // namespace lanecast
