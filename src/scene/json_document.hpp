#pragma once
// A JSON text as one flat array of nodes in the order of the text: no allocation per value, and the k-th node is the k-th
// value or key of the text, so a node's line and column can be found again by counting (source_map.hpp).

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lanecast {

using NodeId = std::uint32_t;
inline constexpr NodeId no_node = 0xffffffffu;

/// Containers nested deeper than this are refused: the format needs 8 levels, comments of users a few more.
inline constexpr std::size_t max_json_depth = 64;

enum class JsonKind : std::uint8_t { null, boolean, number, text, list, object, key };

/// 16 bytes. In an object each key node is followed by its value.
struct JsonNode {
    struct Text {
        std::uint32_t offset, length; ///< in JsonDocument::texts
    };
    JsonKind kind = JsonKind::null;
    NodeId next = 0; ///< one past the last node inside; for a key, its value
    union {
        double number = 0;
        bool boolean;
        std::uint32_t count; ///< of a list's items or an object's keys
        Text text;           ///< of a text or a key, escapes resolved
    };
};

struct JsonDocument {
    std::string_view source;     ///< not owned
    std::vector<JsonNode> nodes; ///< node 0 is the root
    std::string texts;
    bool trailing_text = false; ///< something follows the root value
};

/// False where the text is no JSON, nests deeper than max_json_depth, holds a number that no double can hold, or is
/// larger than 4 GiB; `find_syntax_fault` says where and why. `document.source` must be set.
[[nodiscard]] bool parse_json(JsonDocument& document);

[[nodiscard]] inline std::string_view text_of(const JsonDocument& document, NodeId id) {
    const JsonNode::Text text = document.nodes[id].text;
    return std::string_view(document.texts).substr(text.offset, text.length);
}

} // namespace lanecast
