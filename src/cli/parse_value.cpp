#include "cli/parse_value.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

[[noreturn]] void fail(const std::string& option, const std::string& expected, const std::string& text) {
    throw CLI::ValidationError(option, "must be " + expected + ", got '" + text + "'");
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// `count` whole numbers with `separator` between them.
template <std::size_t count>
std::optional<std::array<int, count>> whole_numbers(std::string_view text, char separator) {
    std::array<int, count> values{};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = i + 1 < count ? text.find(separator) : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const std::optional<int> value = number_of<int>(text.substr(0, end));
        if (!value) return std::nullopt;
        values[i] = *value;
        if (i + 1 < count) text.remove_prefix(end + 1);
    }
    return values;
}

} // namespace

double parse_number(const std::string& option, const std::string& text, const KeySpec& key) {
    const std::optional<double> value = number_of<double>(text);
    const bool whole = key.kind != ValueKind::whole || (value && *value == std::floor(*value));
    if (!value || !std::isfinite(*value) || !whole || !in_range(key, *value)) fail(option, describe(key), text);
    return *value;
}

std::array<int, 2> parse_size(const std::string& option, const std::string& text) {
    const auto size = whole_numbers<2>(text, 'x');
    if (!size || (*size)[0] < 1 || (*size)[1] < 1 || (*size)[0] > largest_resolution || (*size)[1] > largest_resolution)
        fail(option, "WIDTHxHEIGHT, each from 1 to " + std::to_string(largest_resolution), text);
    if (static_cast<double>((*size)[0]) * (*size)[1] > largest_pixel_count)
        fail(option, "at most " + std::to_string(static_cast<int>(largest_pixel_count)) + " pixels", text);
    return *size;
}

Tile parse_crop(const std::string& option, const std::string& text) {
    const auto c = whole_numbers<4>(text, ',');
    if (!c || (*c)[0] < 0 || (*c)[1] < 0 || (*c)[2] <= (*c)[0] || (*c)[3] <= (*c)[1])
        fail(option, "X0,Y0,X1,Y1 in pixels with 0 <= X0 < X1 and 0 <= Y0 < Y1", text);
    return {(*c)[0], (*c)[1], (*c)[2], (*c)[3]};
}

} // namespace lanecast
