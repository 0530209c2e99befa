#pragma once
// The scene format as data: which keys each block has and what their values may be. The loader checks by these tables; a
// test compares them with scenes/scene.schema.json. Defaults are those of the structs in description.hpp.

#include <span>
#include <string>
#include <string_view>

namespace lanecast {

inline constexpr double largest_magnitude = 1e30; ///< of any number in a scene, so that no product of a few overflows
inline constexpr double smallest_length = 1e-30;  ///< of what must not be zero, so that no square underflows
inline constexpr int largest_resolution = 65536;
inline constexpr double largest_pixel_count = 268435456; ///< 2^28

enum class ValueKind {
    number,
    whole, ///< a number without a fraction
    boolean,
    text,
    choice,           ///< one of a few words
    switch_or_choice, ///< the same; false means the first of them, true the second
    numbers,          ///< a list of `length` numbers
    wholes,
    block, ///< an object with a table of its own
    list,  ///< checked by the code that reads it
};

struct Range {
    double low = -largest_magnitude;
    double high = largest_magnitude;
    bool low_open = false; ///< `low` itself is outside
    bool high_open = false;
};

/// What a list of numbers must fulfil as a whole.
enum class Rule {
    none,
    not_all_zero, ///< directions, axes, normals, attenuation
    none_is_zero, ///< scales
};

struct KeySpec {
    std::string_view name;
    ValueKind kind = ValueKind::number;
    bool required = false;
    Range range = {}; ///< of a number or each of the numbers; low = 0 and low_open means at least smallest_length
    int length = 0;
    Rule rule = Rule::none;
    std::string_view what = {}; ///< of lists: "a colour [r, g, b]"
    std::span<const std::string_view> choices = {};
};

struct BlockSpec {
    std::string_view name;  ///< its definition in the schema
    std::string_view title; ///< "a sphere"
    std::span<const KeySpec> keys;
};

namespace format {
extern const BlockSpec scene, camera, render, anti_aliasing, material;
extern const std::span<const BlockSpec> shapes;          ///< sphere, cylinder, cone, plane, mesh: by `type`
extern const std::span<const BlockSpec> transformations; ///< rotation, scale, translate
extern const std::span<const BlockSpec> lights;          ///< ambient, directional, point, spot
} // namespace format

/// Every block, for tests.
[[nodiscard]] std::span<const BlockSpec* const> scene_format();

/// What an error adds that is a warning without --strict.
inline constexpr std::string_view strict_suffix = " (a warning, but --strict was given)";

/// Keys that are skipped without a word: `_anything`, `comment`, `$schema`.
[[nodiscard]] bool is_comment_key(std::string_view key);

/// "a number from 0 to 1", to follow "must be".
[[nodiscard]] std::string describe(const KeySpec& key);
[[nodiscard]] std::string describe_item(const KeySpec& key); ///< of one of `numbers` or `wholes`

/// Whether a number, or one of the numbers, is in the key's range.
[[nodiscard]] bool in_range(const KeySpec& key, double value);

} // namespace lanecast
