// The only file that includes nlohmann. Its SAX interface is used, not its tree: a tree of 16-byte values in vectors costs
// three allocations per mesh triangle, and hides repeated keys.

#include "scene/json_document.hpp"

#include <nlohmann/json.hpp>

namespace lanecast {
namespace {

class NodeBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit NodeBuilder(JsonDocument& document) : document_(document) {}

    bool null() override { return add(JsonKind::null), true; }
    bool boolean(bool value) override { return add(JsonKind::boolean).boolean = value, true; }
    bool number_integer(number_integer_t value) override { return number_float(static_cast<double>(value), {}); }
    bool number_unsigned(number_unsigned_t value) override { return number_float(static_cast<double>(value), {}); }
    bool number_float(number_float_t value, const string_t&) override { return add(JsonKind::number).number = value, true; }
    bool string(string_t& value) override { return add_text(JsonKind::text, value); }
    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(JsonKind::object); }
    bool start_array(std::size_t) override { return open(JsonKind::list); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& value) override {
        ++document_.nodes[open_.back()].count;
        return add_text(JsonKind::key, value);
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        document_.trailing_text = open_.empty() && !document_.nodes.empty();
        return document_.trailing_text;
    }

private:
    JsonNode& add(JsonKind kind) {
        std::vector<JsonNode>& nodes = document_.nodes;
        if (kind != JsonKind::key && !open_.empty() && nodes[open_.back()].kind == JsonKind::list) ++nodes[open_.back()].count;
        JsonNode& node = nodes.emplace_back();
        node.kind = kind;
        node.next = static_cast<NodeId>(nodes.size());
        return node;
    }
    bool add_text(JsonKind kind, const std::string& value) {
        add(kind).text = {static_cast<std::uint32_t>(document_.texts.size()), static_cast<std::uint32_t>(value.size())};
        document_.texts += value;
        return true;
    }
    bool open(JsonKind kind) {
        if (open_.size() == max_json_depth) return false;
        add(kind).count = 0;
        open_.push_back(static_cast<NodeId>(document_.nodes.size() - 1));
        return true;
    }
    bool close() {
        document_.nodes[open_.back()].next = static_cast<NodeId>(document_.nodes.size());
        open_.pop_back();
        return true;
    }

    JsonDocument& document_;
    std::vector<NodeId> open_;
};

} // namespace

bool parse_json(JsonDocument& document) {
    const std::string_view source = document.source;
    if (source.size() >= no_node) return false; // so node ids and offsets fit 32 bits
    NodeBuilder builder(document);
    if (!nlohmann::json::sax_parse(source.begin(), source.end(), &builder)) return false;
    // nlohmann takes a zero byte for the end of its input.
    if (source.find('\0') != std::string_view::npos) document.trailing_text = true;
    return true;
}

} // namespace lanecast
