// The schema, the loader's tables and what the loader does: three statements of one format, compared with each other.

#include "scene/error.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene_format.hpp"
#include "scene/schema.hpp"

#include "scene/write_scene.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <doctest/doctest.h>

using namespace lanecast;

namespace {

const Json& schema() {
    static const Json parsed = Json::parse(scene_schema());
    return parsed;
}

const Json& definition(const BlockSpec& block) {
    return block.name == "scene" ? schema() : schema()["definitions"][std::string(block.name)];
}

const Json& property(const BlockSpec& block, const KeySpec& key) {
    return definition(block)["properties"][std::string(key.name)];
}

/// The smallest valid form of a block: what it requires, and nothing else.
Json minimal(std::string_view block) {
    const Json up = {0, 1, 0};
    const Json one = {1, 1, 1};
    if (block == "scene") return {{"camera", Json::object()}, {"objects", Json::array()}, {"lights", Json::array()}};
    if (block == "camera" || block == "render" || block == "material") return Json::object();
    if (block == "anti_aliasing") return {{"mode", "grid"}};
    Json out = {{"type", block}};
    if (block == "sphere") out.update({{"radius", 1}, {"material", Json::object()}});
    if (block == "cylinder") out.update({{"radius", 1}, {"height", 1}, {"material", Json::object()}});
    if (block == "cone") out.update({{"base_radius", 1}, {"height", 1}, {"material", Json::object()}});
    if (block == "plane") out.update({{"position", up}, {"normal", up}, {"material", Json::object()}});
    if (block == "mesh") out.update({{"triangles", {{up, one, {2, 1, 4}}}}, {"material", Json::object()}});
    if (block == "rotation") out.update({{"axis", up}, {"degrees", 30}});
    if (block == "scale") out.update({{"scale", one}});
    if (block == "translate") out.update({{"translate", one}});
    if (block == "ambient" || block == "directional" || block == "point" || block == "spot") out["color"] = one;
    if (block == "point" || block == "spot") out["position"] = up;
    if (block == "directional" || block == "spot") out["direction"] = up;
    if (block == "spot") out["cutoff"] = 20;
    return out;
}

/// A scene with the block in it, and the JSON pointer to it.
std::pair<Json, std::string> scene_with(std::string_view name, const Json& block) {
    Json scene = minimal("scene");
    if (name == "scene") return {block, ""};
    if (name == "camera" || name == "render") return scene[std::string(name)] = block, std::pair(scene, "/" + std::string(name));
    if (name == "anti_aliasing")
        return scene["render"]["anti_aliasing"] = block, std::pair(scene, std::string("/render/anti_aliasing"));
    if (name == "ambient" || name == "directional" || name == "point" || name == "spot")
        return scene["lights"].push_back(block), std::pair(scene, std::string("/lights/0"));
    Json object = block;
    std::string place = "/objects/0";
    if (name == "material") object = minimal("sphere"), object["material"] = block, place += "/material";
    if (name == "rotation" || name == "scale" || name == "translate")
        object = minimal("sphere"), object["transformations"] = Json::array({block}), place += "/transformations/0";
    scene["objects"].push_back(object);
    return {scene, place};
}

/// The description that the loader makes of a scene with this block, or its message.
struct Outcome {
    Json description;
    std::string error;
};
Outcome outcome(std::string_view name, const Json& block) {
    try {
        const LoadedScene loaded = parse_scene(scene_with(name, block).first.dump(1), "s.json", {}, {.strict = true});
        return {to_json(loaded.description), {}};
    } catch (const Error& error) {
        return {{}, error.what()};
    }
}

void check_refused(const BlockSpec& block, const KeySpec& key, const Json& value) {
    CAPTURE(value.dump());
    Json changed = minimal(block.name);
    changed[std::string(key.name)] = value;
    const std::string error = outcome(block.name, changed).error;
    CHECK_MESSAGE(error.find("error: " + scene_with(block.name, {}).second + "/" + std::string(key.name)) != std::string::npos,
                  error);
}

void check_accepted(const BlockSpec& block, const KeySpec& key, const Json& value) {
    CAPTURE(value.dump());
    Json changed = minimal(block.name);
    changed[std::string(key.name)] = value;
    CHECK(outcome(block.name, changed).error == "");
}

/// Ends of the range in the schema's words; those it does not have are infinite.
struct Ends {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool low_open = false, high_open = false;
};
Ends ends_of(const Json& numbers) {
    Ends out;
    if (numbers.contains("minimum")) out.low = numbers["minimum"];
    if (numbers.contains("maximum")) out.high = numbers["maximum"];
    if (numbers.contains("exclusiveMinimum")) out.low = numbers["exclusiveMinimum"], out.low_open = true;
    if (numbers.contains("exclusiveMaximum")) out.high = numbers["exclusiveMaximum"], out.high_open = true;
    return out;
}

/// Values at, inside and outside the ends. `wrap` makes the key's value of a number.
template <class Wrap>
void check_range(const BlockSpec& block, const KeySpec& key, const Json& numbers, bool ends_allowed, Wrap&& wrap) {
    const Ends ends = ends_of(numbers);
    CHECK(ends.low == key.range.low);
    CHECK(ends.high == key.range.high);
    CHECK(ends.low_open == key.range.low_open);
    CHECK(ends.high_open == key.range.high_open);
    const bool whole = numbers["type"] == "integer";
    const auto number = [&](double value) {
        return whole && std::abs(value) < 1e9 ? wrap(Json(static_cast<int>(value))) : wrap(Json(value));
    };
    const double step_below = whole ? 1 : std::max(1e-3, std::abs(ends.low) * 1e-6);
    const double step_above = whole ? 1 : std::max(1e-3, std::abs(ends.high) * 1e-6);
    check_refused(block, key, number(ends.low - step_below));
    check_refused(block, key, number(ends.high + step_above));
    if (ends.low_open)
        check_refused(block, key, number(ends.low));
    else if (ends_allowed)
        check_accepted(block, key, number(ends.low));
    if (ends.high_open)
        check_refused(block, key, number(ends.high));
    else if (ends_allowed)
        check_accepted(block, key, number(ends.high));
    const bool bounded = ends.high < largest_magnitude;
    check_accepted(block, key, number(whole ? ends.low + 1 : bounded ? ends.low + (ends.high - ends.low) / 3 : 5));
    check_refused(block, key, wrap(Json("1")));
    check_refused(block, key, wrap(Json(nullptr)));
    if (whole) check_refused(block, key, wrap(Json(1.5)));
}

void check_numbers(const BlockSpec& block, const KeySpec& key, const Json& rule) {
    const auto length = static_cast<std::size_t>(key.length);
    CHECK(rule["type"] == "array");
    CHECK(rule["minItems"] == key.length);
    CHECK(rule["maxItems"] == key.length);
    // A camera that looks along its up direction is refused for another reason.
    const bool ends_allowed = key.rule != Rule::none_is_zero && key.name != "look_at" && key.name != "up";
    for (std::size_t i = 0; i < length; ++i) {
        check_range(block, key, rule["items"], ends_allowed, [&](const Json& item) {
            Json list = Json::array();
            for (std::size_t j = 0; j < length; ++j) list.push_back(2 + j);
            list[i] = item;
            return list;
        });
    }
    for (const std::size_t wrong : {length - 1, length + 1}) check_refused(block, key, Json(std::vector<int>(wrong, 1)));
    check_refused(block, key, 1);
    const Json zeros(std::vector<int>(length, 0));
    if (key.rule == Rule::not_all_zero) check_refused(block, key, zeros);
    if (key.rule == Rule::none_is_zero) check_refused(block, key, {1, 0, 1});
    CHECK(rule["items"].contains("not") == (key.rule == Rule::none_is_zero));
}

std::string expected_type(const KeySpec& key) {
    switch (key.kind) {
    case ValueKind::number:
        return "number";
    case ValueKind::whole:
        return "integer";
    case ValueKind::boolean:
        return "boolean";
    case ValueKind::text:
        return "string";
    case ValueKind::numbers:
    case ValueKind::wholes:
    case ValueKind::list:
        return "array";
    case ValueKind::choice:
    case ValueKind::switch_or_choice:
    case ValueKind::block:
        break;
    }
    return "";
}

} // namespace

TEST_CASE("the schema in the program is the file") {
    std::ifstream file(std::string(LANECAST_SOURCE_DIR) + "/scenes/scene.schema.json");
    std::stringstream text;
    text << file.rdbuf();
    CHECK(text.str() == scene_schema());
}

TEST_CASE("schema and tables have the same blocks and keys") {
    std::set<std::string> blocks;
    for (const auto& [name, unused] : schema()["definitions"].items()) blocks.insert(name);
    CHECK(blocks.size() + 1 == scene_format().size());
    for (const BlockSpec* const block : scene_format()) {
        CAPTURE(block->name);
        CHECK((block->name == "scene" || blocks.contains(std::string(block->name))));
        const Json& rules = definition(*block);
        CHECK(rules["properties"].size() == block->keys.size());
        CHECK(rules["description"].is_string());
        CHECK(rules["additionalProperties"] == false);
        std::set<std::string> required;
        for (const KeySpec& key : block->keys) {
            CAPTURE(key.name);
            REQUIRE(rules["properties"].contains(std::string(key.name)));
            const Json& rule = property(*block, key);
            if (key.required) required.insert(std::string(key.name));
            CHECK(rule["description"].is_string());
            CHECK(rule.value("type", "") == expected_type(key));
            // Whether it may be left out, and what it then is. A block's defaults are those of its keys.
            const bool one_of_two = key.name == "triangles" || key.name == "file";
            const bool follows_position = key.name == "look_at";
            CHECK(rule.contains("default") ==
                  (!key.required && key.kind != ValueKind::block && !one_of_two && !follows_position));
        }
        CHECK(rules.value("required", std::set<std::string>{}) == required);
    }
}

TEST_CASE("the loader takes what the schema allows and refuses the rest") {
    for (const BlockSpec* const block : scene_format()) {
        CAPTURE(block->name);
        REQUIRE(outcome(block->name, minimal(block->name)).error == "");
        for (const KeySpec& key : block->keys) {
            CAPTURE(key.name);
            const Json& rule = property(*block, key);
            switch (key.kind) {
            case ValueKind::number:
            case ValueKind::whole:
                check_range(*block, key, rule, true, [](const Json& value) { return value; });
                break;
            case ValueKind::numbers:
            case ValueKind::wholes:
                check_numbers(*block, key, rule);
                break;
            case ValueKind::boolean:
                for (const bool value : {false, true}) check_accepted(*block, key, value);
                for (const Json& value : {Json(0), Json("true"), Json(nullptr)}) check_refused(*block, key, value);
                break;
            case ValueKind::text:
                if (key.name != "file") check_accepted(*block, key, "some text");
                check_refused(*block, key, 1);
                break;
            case ValueKind::choice: {
                std::vector<std::string> words;
                if (rule.contains("const"))
                    words = {rule["const"]};
                else
                    words = rule["enum"];
                CHECK(words == std::vector<std::string>(key.choices.begin(), key.choices.end()));
                for (const std::string& word : words) check_accepted(*block, key, word);
                check_refused(*block, key, "no such word");
                check_refused(*block, key, 0);
                break;
            }
            case ValueKind::switch_or_choice: {
                Json values = {false, true};
                for (const std::string_view word : key.choices) values.push_back(word);
                CHECK(rule["enum"] == values);
                for (const Json& value : values) check_accepted(*block, key, value);
                for (const Json& value : {Json(0), Json("true"), Json(nullptr)}) check_refused(*block, key, value);
                break;
            }
            case ValueKind::block:
            case ValueKind::list:
                check_refused(*block, key, 1);
                break;
            }
        }
    }
    // The one list without a block of its own.
    const Ends coordinate = ends_of(schema()["definitions"]["mesh"]["properties"]["triangles"]["items"]["items"]["items"]);
    CHECK(coordinate.low == -largest_magnitude);
    CHECK(coordinate.high == largest_magnitude);
}

TEST_CASE("defaults are those of the schema, and every key is read") {
    for (const BlockSpec* const block : scene_format()) {
        CAPTURE(block->name);
        const Json without = outcome(block->name, minimal(block->name)).description;
        for (const KeySpec& key : block->keys) {
            CAPTURE(key.name);
            const std::string name(key.name);
            const Json& rule = property(*block, key);
            if (key.required && block->name != "anti_aliasing") { // missing: an error at the block
                Json lacking = minimal(block->name);
                lacking.erase(name);
                CHECK(outcome(block->name, lacking).error.find("lacks the key `" + name + "`") != std::string::npos);
            }
            if (rule.contains("default")) {
                Json same = minimal(block->name);
                same[name] = rule["default"];
                CHECK(outcome(block->name, same).description == without);
            }
            // Another value gives another description.
            Json other = minimal(block->name);
            const std::vector<double> numbers = {0.25, 0.5, 0.75};
            switch (key.kind) {
            case ValueKind::number:
                other[name] = 0.625;
                break;
            case ValueKind::whole:
                other[name] = 17;
                break;
            case ValueKind::boolean:
                other[name] = !rule["default"].get<bool>();
                break;
            case ValueKind::text:
                other[name] = "other";
                break;
            case ValueKind::numbers:
                other[name] = numbers;
                break;
            case ValueKind::wholes:
                other[name] = {64, 48};
                break;
            case ValueKind::choice:
            case ValueKind::switch_or_choice:
                other[name] = std::string(key.choices.back());
                break;
            case ValueKind::block:
            case ValueKind::list:
                continue;
            }
            if (name == "type" || name == "file") continue;
            const Outcome changed = outcome(block->name, other);
            CHECK(changed.error == "");
            CHECK(changed.description != without);
        }
    }
}
