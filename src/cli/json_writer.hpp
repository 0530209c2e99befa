#pragma once
// JSON out, for --json: two spaces per level, lists of numbers on one line, numbers by the shortest text that reads back.

#include <charconv>
#include <cmath>
#include <concepts>
#include <span>
#include <string>
#include <string_view>

namespace lanecast {

template <class T>
concept JsonNumber = std::integral<T> || std::floating_point<T>;

/// Calls are in the order of the text. Every block that is opened is closed.
class JsonWriter {
public:
    void open_object(std::string_view key = {}) { open(key, '{'); }
    void open_list(std::string_view key = {}) { open(key, '['); }
    void close_object() { close('}'); }
    void close_list() { close(']'); }

    void add(std::string_view key, std::string_view value) {
        begin(key);
        quote(value);
    }
    void add(std::string_view key, const char* value) { add(key, std::string_view(value)); }
    template <JsonNumber T>
    void add(std::string_view key, T value) {
        begin(key);
        number(value);
    }
    template <JsonNumber T>
    void add_numbers(std::string_view key, std::span<const T> values) {
        begin(key);
        text_ += '[';
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i > 0) text_ += ", ";
            number(values[i]);
        }
        text_ += ']';
    }
    void add_null(std::string_view key) {
        begin(key);
        text_ += "null";
    }

    /// The whole text, with a line break at its end.
    [[nodiscard]] std::string finished() const { return text_ + "\n"; }

private:
    void open(std::string_view key, char bracket) {
        begin(key);
        text_ += bracket;
        ++depth_;
        first_ = true;
    }
    void close(char bracket) {
        --depth_;
        if (!first_) new_line();
        text_ += bracket;
        first_ = false;
    }
    /// Key: empty in lists.
    void begin(std::string_view key) {
        if (!first_) text_ += ',';
        if (depth_ > 0) new_line();
        first_ = false;
        if (key.empty()) return;
        quote(key);
        text_ += ": ";
    }
    void new_line() { text_ += '\n' + std::string(static_cast<std::size_t>(2 * depth_), ' '); }
    template <JsonNumber T>
    void number(T value) {
        if constexpr (std::same_as<T, bool>) {
            text_ += value ? "true" : "false";
        } else {
            if constexpr (std::floating_point<T>)
                if (!std::isfinite(value)) return void(text_ += "null"); // JSON has no word for it
            char digits[32];
            text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
        }
    }
    void quote(std::string_view text) {
        text_ += '"';
        for (const char c : text) {
            static constexpr char hex[] = "0123456789abcdef";
            if (c == '"' || c == '\\')
                (text_ += '\\') += c;
            else if (c == '\n')
                text_ += "\\n";
            else if (static_cast<unsigned char>(c) < 0x20)
                ((text_ += "\\u00") += hex[c >> 4]) += hex[c & 15];
            else
                text_ += c;
        }
        text_ += '"';
    }

    std::string text_;
    int depth_ = 0;
    bool first_ = true;
};

} // namespace lanecast
