// The slow tokenizer against nlohmann: they must agree on what is JSON, and on which value is where.

#include "scene/diagnostic.hpp"
#include "scene/source_map.hpp"

#include <random>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace lanecast;

namespace {

using Json = nlohmann::ordered_json;

std::mt19937_64 generator(1);
int whole(int low, int high) { return std::uniform_int_distribution(low, high)(generator); }

Json random_json(int depth) {
    switch (whole(0, depth > 0 ? 7 : 5)) {
    case 0:
        return nullptr;
    case 1:
        return whole(0, 1) == 1;
    case 2:
        return whole(-1000, 1000);
    case 3:
        return std::uniform_real_distribution(-1e6, 1e6)(generator);
    case 4:
        return "text { [ , : \\ \" \u00e9\U0001F600\n";
    case 5:
        return "";
    case 6: {
        Json out = Json::array();
        for (int i = whole(0, 4); i > 0; --i) out.push_back(random_json(depth - 1));
        return out;
    }
    default: {
        Json out = Json::object();
        const char* const keys[] = {"a", "b/c", "d~", "\u20ac", "", "e\"f"};
        for (int i = whole(0, 4); i > 0; --i) out[keys[whole(0, 5)]] = random_json(depth - 1);
        return out;
    }
    }
}

/// Every node's span must hold the text that parses to what nlohmann finds at the node's pointer.
void check_places(const std::string& text, const Json& json) {
    JsonDocument document{};
    document.source = text;
    REQUIRE(parse_json(document));
    std::vector<NodeId> ids;
    for (NodeId id = 0; id < document.nodes.size(); ++id) ids.push_back(id);
    const std::vector<SourceSpan> spans = locate_nodes(text, ids);
    for (const NodeId id : ids) {
        const std::string pointer = pointer_to(document, id);
        const Json& value = json.at(Json::json_pointer(pointer));
        REQUIRE(node_at(document, pointer) == (document.nodes[id].kind == JsonKind::key ? id + 1 : id)); // a key: its value
        REQUIRE(node_at(document, pointer + "/no such") == no_node);
        const std::string shown = text.substr(spans[id].begin, spans[id].end - spans[id].begin);
        switch (document.nodes[id].kind) {
        case JsonKind::list:
            REQUIRE(shown == "[");
            REQUIRE(value.size() == document.nodes[id].count);
            break;
        case JsonKind::object:
            REQUIRE(shown == "{");
            REQUIRE(value.size() == document.nodes[id].count);
            break;
        case JsonKind::key:
            REQUIRE(Json::parse(shown) == text_of(document, id));
            break;
        case JsonKind::number:
            REQUIRE(Json::parse(shown) == value);
            REQUIRE(document.nodes[id].number == value.get<double>());
            break;
        case JsonKind::text:
            REQUIRE(Json::parse(shown) == value);
            REQUIRE(text_of(document, id) == value.get<std::string>());
            break;
        case JsonKind::boolean:
            REQUIRE(document.nodes[id].boolean == value.get<bool>());
            [[fallthrough]];
        case JsonKind::null:
            REQUIRE(Json::parse(shown) == value);
            break;
        }
    }
}

} // namespace

TEST_CASE("every value and key of random JSON is found where it stands") {
    for (int i = 0; i < 3000; ++i) {
        const Json json = random_json(5);
        const std::string text = json.dump(whole(-1, 3), whole(0, 1) == 1 ? ' ' : '\t', whole(0, 1) == 1);
        CAPTURE(text);
        check_places(text, json);
    }
}

TEST_CASE("tokenizer and parser agree on damaged JSON") {
    const std::string_view alphabet = "{}[]:,\"\\/-+.0123456789eEtrufalsn \n\t\x01\x80\xc3\xa9\xf0_";
    int refused = 0;
    for (int i = 0; i < 60000; ++i) {
        std::string text = random_json(3).dump(whole(-1, 1));
        for (int edits = whole(1, 3); edits > 0; --edits) {
            const auto at = static_cast<std::size_t>(whole(0, static_cast<int>(text.size())));
            const char c = alphabet[static_cast<std::size_t>(whole(0, static_cast<int>(alphabet.size()) - 1))];
            switch (whole(0, 3)) {
            case 0:
                text.insert(text.begin() + static_cast<std::ptrdiff_t>(at), c);
                break;
            case 1:
                text.erase(at, 1);
                break;
            case 2:
                text.resize(at);
                break;
            default:
                if (at < text.size()) text[at] = c;
            }
        }
        JsonDocument document{};
        document.source = text;
        const bool parsed = parse_json(document);
        CAPTURE(text);
        if (parsed) {
            // `012`: a number and trailing text to the one, a malformed number to the other. As a scene, neither is any good.
            if (document.nodes[0].kind == JsonKind::number) continue;
            const std::size_t rest = find_trailing_text(text);
            REQUIRE(document.trailing_text == (rest < text.size()));
            REQUIRE(Json::accept(text.substr(0, rest)));
        } else {
            ++refused;
            const SyntaxFault fault = find_syntax_fault(text);
            REQUIRE(fault.message != "malformed JSON"); // the tokenizer found nothing wrong
            REQUIRE(fault.offset <= text.size());
            REQUIRE(!Json::accept(text));
        }
    }
    CHECK(refused > 10000);
}

TEST_CASE("lines and columns") {
    const std::string text = "ab\n\tc\r\n\n\u00e9\U0001F600d";
    const auto at = [&](std::size_t offset) {
        const LineColumn place = line_column(text, offset);
        return std::pair(place.line, place.column);
    };
    using P = std::pair<std::size_t, std::size_t>;
    CHECK(at(0) == P(1, 1));
    CHECK(at(2) == P(1, 3)); // the line break itself
    CHECK(at(3) == P(2, 1));
    CHECK(at(4) == P(2, 2));
    CHECK(at(7) == P(3, 1));
    CHECK(at(8) == P(4, 1));
    CHECK(at(10) == P(4, 2));
    CHECK(at(14) == P(4, 3));
    CHECK(at(999) == P(4, 4));
    CHECK(line_column("\xef\xbb\xbf{", 3).column == 1);
}

TEST_CASE("a long line of malformed UTF-8 is shown, cut and harmless") {
    for (const std::size_t place : {0, 1, 60, 100, 250, 299}) {
        const std::string text = "{}\n" + std::string(300, '\xab') + "\n{}";
        const std::string message = format_diagnostic("f", text, 3 + place, "error", "m");
        CHECK(message.starts_with("f:2:"));
        CHECK(message.size() < 400);
        CHECK(message.find('{') == std::string::npos);
    }
}
