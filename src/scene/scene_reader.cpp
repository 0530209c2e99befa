#include "scene/scene_reader.hpp"

#include "scene/diagnostic.hpp"
#include "scene/source_map.hpp"
#include "scene/text_tools.hpp"

#include <cmath>
#include <unordered_set>

namespace lanecast {
namespace {

const std::vector<JsonNode>& nodes(const SceneReader& reader) { return reader.document.nodes; }

[[noreturn]] void fail_type(const SceneReader& reader, NodeId node, const std::string& wanted) {
    fail(reader, node, "must be " + wanted + ", got " + shown(reader, node));
}

void check_number(const SceneReader& reader, const KeySpec& key, NodeId node) {
    if (nodes(reader)[node].kind != JsonKind::number) fail_type(reader, node, describe_item(key));
    const double value = nodes(reader)[node].number;
    const bool whole = key.kind == ValueKind::whole || key.kind == ValueKind::wholes;
    if (in_range(key, value) && !(whole && value != std::floor(value))) return;
    if (std::abs(value) > largest_magnitude) fail_type(reader, node, "a number between -1e30 and 1e30");
    if (value > 0 && value < smallest_length) fail_type(reader, node, "at least 1e-30");
    fail_type(reader, node, describe_item(key));
}

void check_numbers(const SceneReader& reader, const KeySpec& key, NodeId node) {
    const JsonNode& list = nodes(reader)[node];
    if (list.kind != JsonKind::list || list.count != static_cast<std::uint32_t>(key.length))
        fail_type(reader, node, describe(key));
    double largest = 0;
    for (NodeId item = node + 1; item < list.next; item = nodes(reader)[item].next) {
        check_number(reader, key, item);
        const double magnitude = std::abs(nodes(reader)[item].number);
        largest = std::max(largest, magnitude);
        if (key.rule == Rule::none_is_zero && magnitude < smallest_length)
            fail(reader, item, "must not be zero, got " + shown(reader, item) + ": the object would be flat");
    }
    if (key.rule == Rule::not_all_zero && largest < smallest_length)
        fail(reader, node, largest == 0 ? "must not be all zero" : "must have a component of at least 1e-30");
}

void check_choice(const SceneReader& reader, const KeySpec& key, NodeId node) {
    if (nodes(reader)[node].kind != JsonKind::text) fail_type(reader, node, describe(key));
    const std::string_view word = text_of(reader.document, node);
    for (const std::string_view choice : key.choices)
        if (word == choice) return;
    const std::string_view nearest = nearest_word(word, key.choices);
    const std::string hint = nearest.empty() ? "" : "; did you mean `" + std::string(nearest) + "`?";
    fail(reader, node, "must be " + describe(key) + ", got " + shown(reader, node) + hint);
}

void check_value(const SceneReader& reader, const KeySpec& key, NodeId node) {
    const auto check_kind = [&](JsonKind kind) {
        if (nodes(reader)[node].kind != kind) fail_type(reader, node, describe(key));
    };
    switch (key.kind) {
    case ValueKind::number:
    case ValueKind::whole:
        return check_number(reader, key, node);
    case ValueKind::numbers:
    case ValueKind::wholes:
        return check_numbers(reader, key, node);
    case ValueKind::choice:
        return check_choice(reader, key, node);
    case ValueKind::switch_or_choice:
        if (nodes(reader)[node].kind != JsonKind::boolean) check_choice(reader, key, node);
        return;
    case ValueKind::boolean:
        return check_kind(JsonKind::boolean);
    case ValueKind::text:
        return check_kind(JsonKind::text);
    case ValueKind::block:
        return check_kind(JsonKind::object);
    case ValueKind::list:
        return check_kind(JsonKind::list);
    }
}

std::vector<std::string_view> key_names(const BlockSpec& spec) {
    std::vector<std::string_view> out;
    for (const KeySpec& key : spec.keys) out.push_back(key.name);
    return out;
}

} // namespace

std::string message_at(const SceneReader& reader, NodeId node, std::string_view severity, const std::string& message) {
    const std::string place = pointer_to(reader.document, node);
    const SourceSpan span = locate_nodes(reader.document.source, {node})[0];
    return format_diagnostic(reader.name, reader.document.source, span.begin, severity,
                             place.empty() ? message : place + ": " + message);
}

void fail(const SceneReader& reader, NodeId node, const std::string& message, ExitCode code) {
    throw Error(code, message_at(reader, node, "error", message));
}

void warn(SceneReader& reader, NodeId node, const std::string& message) {
    if (reader.strict) fail(reader, node, message + std::string(strict_suffix));
    if (reader.remarks.size() < max_remarks)
        reader.remarks.push_back({node, message});
    else
        ++reader.remarks_dropped;
}

std::string more_warnings(std::size_t count) { return std::to_string(count) + (count == 1 ? " more warning" : " more warnings"); }

std::string shown(const SceneReader& reader, NodeId node) {
    const JsonNode& value = nodes(reader)[node];
    switch (value.kind) {
    case JsonKind::null:
        return "null";
    case JsonKind::boolean:
        return value.boolean ? "true" : "false";
    case JsonKind::text:
        return "\"" + printable(text_of(reader.document, node), 40) + "\"";
    case JsonKind::list:
        return value.count == 0 ? "an empty list" : "a list of " + std::to_string(value.count);
    case JsonKind::object:
        return "an object";
    case JsonKind::number:
    case JsonKind::key:
        break;
    }
    const SourceSpan span = locate_nodes(reader.document.source, {node})[0];
    return printable(reader.document.source.substr(span.begin, span.end - span.begin), 40);
}

std::vector<NodeId> items(const SceneReader& reader, NodeId list) {
    std::vector<NodeId> out;
    for (NodeId item = list + 1; item < nodes(reader)[list].next; item = nodes(reader)[item].next) out.push_back(item);
    return out;
}

Block::Block(SceneReader& reader, NodeId node, const BlockSpec& spec)
    : reader_(reader), spec_(spec), node_(node), values_(spec.keys.size(), no_node) {
    if (nodes(reader)[node].kind != JsonKind::object)
        fail(reader, node, std::string(node == 0 ? "the scene " : "") + "must be an object { ... }, got " + shown(reader, node));
    std::unordered_set<std::string_view> unknown;
    for (NodeId key = node + 1; key < nodes(reader)[node].next; key = nodes(reader)[key + 1].next) {
        const std::string_view name = text_of(reader.document, key);
        if (is_comment_key(name)) continue;
        std::size_t index = 0;
        while (index < spec.keys.size() && spec.keys[index].name != name) ++index;
        const bool known = index < spec.keys.size();
        if (known ? values_[index] != no_node : !unknown.insert(name).second) fail(reader, key, "the key is repeated");
        if (known) {
            values_[index] = key + 1;
            check_value(reader, spec.keys[index], key + 1);
            continue;
        }
        // Not for the thousandth unknown key: the search costs a microsecond per known one.
        const std::string_view nearest =
            reader.remarks.size() < max_remarks ? nearest_word(name, key_names(spec)) : std::string_view();
        if (misspelt_ == no_node && !nearest.empty()) misspelt_ = key, meant_ = nearest;
        warn(reader, key,
             "unknown key of " + std::string(spec.title) +
                 (nearest.empty() ? "" : "; did you mean `" + std::string(nearest) + "`?"));
    }
    check_missing();
}

void Block::check_missing() const {
    for (std::size_t i = 0; i < spec_.keys.size(); ++i) {
        const KeySpec& key = spec_.keys[i];
        if (!key.required || values_[i] != no_node) continue;
        fail(reader_, node_,
             std::string(node_ == 0 ? "the scene " : "") + "lacks the key `" + std::string(key.name) + "`" +
                 misspelling(key.name));
    }
}

std::string Block::misspelling(std::string_view key) const {
    return meant_ == key ? "; was `" + printable(text_of(reader_.document, misspelt_), 40) + "` meant for it?" : "";
}

NodeId Block::find(std::string_view key) const {
    for (std::size_t i = 0; i < spec_.keys.size(); ++i)
        if (spec_.keys[i].name == key) return values_[i];
    return no_node;
}

NodeId Block::place_of(std::string_view key) const {
    const NodeId value = find(key);
    return value == no_node ? node_ : value;
}

void Block::read(std::string_view key, double& value) const {
    if (const NodeId at = find(key); at != no_node) value = nodes(reader_)[at].number;
}
void Block::read(std::string_view key, int& value) const {
    if (const NodeId at = find(key); at != no_node) value = static_cast<int>(nodes(reader_)[at].number);
}
void Block::read(std::string_view key, bool& value) const {
    if (const NodeId at = find(key); at != no_node) value = nodes(reader_)[at].boolean;
}
void Block::read(std::string_view key, std::string& value) const {
    if (const NodeId at = find(key); at != no_node) value = text_of(reader_.document, at);
}
void Block::read(std::string_view key, glm::dvec3& value) const {
    // The items are scalars, so their nodes are neighbours.
    if (const NodeId at = find(key); at != no_node)
        value = {nodes(reader_)[at + 1].number, nodes(reader_)[at + 2].number, nodes(reader_)[at + 3].number};
}
void Block::read(std::string_view key, std::array<double, 3>& value) const {
    if (const NodeId at = find(key); at != no_node)
        for (NodeId i = 0; i < 3; ++i) value[i] = nodes(reader_)[at + 1 + i].number;
}
void Block::read(std::string_view key, std::array<int, 2>& value) const {
    if (const NodeId at = find(key); at != no_node)
        for (NodeId i = 0; i < 2; ++i) value[i] = static_cast<int>(nodes(reader_)[at + 1 + i].number);
}

int Block::choice(std::string_view key) const {
    for (std::size_t i = 0; i < spec_.keys.size(); ++i) {
        if (spec_.keys[i].name != key || values_[i] == no_node) continue;
        if (nodes(reader_)[values_[i]].kind == JsonKind::boolean) return nodes(reader_)[values_[i]].boolean ? 1 : 0;
        const std::string_view word = text_of(reader_.document, values_[i]);
        for (std::size_t j = 0; j < spec_.keys[i].choices.size(); ++j)
            if (spec_.keys[i].choices[j] == word) return static_cast<int>(j);
    }
    return -1;
}

const BlockSpec& spec_by_type(const SceneReader& reader, NodeId node, std::span<const BlockSpec> specs) {
    const JsonNode& object = nodes(reader)[node];
    if (object.kind != JsonKind::object) fail_type(reader, node, "an object { ... }");
    std::vector<std::string_view> types;
    for (const BlockSpec& spec : specs) types.push_back(spec.name);
    for (NodeId key = node + 1; key < object.next; key = nodes(reader)[key + 1].next) {
        if (text_of(reader.document, key) != "type") continue;
        const NodeId type = key + 1;
        const KeySpec spec{.name = "type", .kind = ValueKind::choice, .choices = types};
        check_choice(reader, spec, type);
        for (const BlockSpec& candidate : specs)
            if (candidate.name == text_of(reader.document, type)) return candidate;
    }
    fail(reader, node, "lacks the key `type`");
}

} // namespace lanecast
