#include "scene/source_map.hpp"

#include "scene/json_scan.hpp"

#include <algorithm>

namespace lanecast {

SyntaxFault find_syntax_fault(std::string_view text) {
    if (text.size() >= no_node) return {0, {}, "the file is larger than 4 GiB"};
    const JsonScan scan = scan_json(text, {});
    return scan.fault ? *scan.fault : SyntaxFault{std::min(scan.end, text.size()), {}, "malformed JSON"};
}

std::vector<SourceSpan> locate_nodes(std::string_view text, const std::vector<NodeId>& ids) {
    JsonScan scan = scan_json(text, ids);
    scan.found.resize(ids.size());
    return scan.found;
}

std::size_t find_trailing_text(std::string_view text) {
    return std::min(text.find_first_not_of(" \t\r\n", scan_json(text, {}).end), text.size());
}

std::string pointer_to(const JsonDocument& document, NodeId id) {
    const std::vector<JsonNode>& nodes = document.nodes;
    std::string out;
    NodeId at = 0;
    while (at != id && nodes[at].next > id) {
        // `id` is inside container `at`: find the child that holds it.
        NodeId child = at + 1;
        std::size_t index = 0;
        if (nodes[at].kind == JsonKind::object) {
            while (nodes[child + 1].next <= id) child = nodes[child + 1].next;
            out += pointer_step(text_of(document, child));
            if (child == id) return out;
            at = child + 1;
        } else {
            while (nodes[child].next <= id) child = nodes[child].next, ++index;
            out += "/" + std::to_string(index);
            at = child;
        }
    }
    return out;
}

NodeId node_at(const JsonDocument& document, std::string_view pointer) {
    const std::vector<JsonNode>& nodes = document.nodes;
    NodeId at = nodes.empty() ? no_node : 0;
    while (at != no_node && !pointer.empty()) {
        const bool object = nodes[at].kind == JsonKind::object;
        if (!object && nodes[at].kind != JsonKind::list) return no_node;
        const std::string_view step = pointer.substr(0, pointer.find('/', 1));
        const NodeId end = nodes[at].next;
        NodeId child = at + 1;
        for (std::size_t index = 0; child < end; ++index) {
            if (object ? pointer_step(text_of(document, child)) == step : "/" + std::to_string(index) == step) break;
            child = object ? nodes[child + 1].next : nodes[child].next;
        }
        at = child >= end ? no_node : object ? child + 1 : child;
        pointer.remove_prefix(step.size());
    }
    return at;
}

} // namespace lanecast
