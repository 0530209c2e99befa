#include "scene/json_scan.hpp"

#include "scene/read_number.hpp"
#include "scene/text_tools.hpp"

#include <algorithm>
#include <cmath>

namespace lanecast {

std::string pointer_step(std::string_view key) {
    std::string out = "/";
    for (const char c : printable(key)) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// What stands at the start of `text`, for "..., found X".
std::string shown(std::string_view text) {
    if (text.empty()) return "the end of the file";
    if (text[0] == '\0') return "a zero byte";
    if (text[0] == '/' || text[0] == '#')
        return "`" + std::string(1, text[0]) + "`: JSON has no comments, use a key that starts with `_`";
    std::size_t length = 0;
    while (length < text.size() &&
           (is_word(text[length]) || ((text[length] == '.' || text[length] == '-' || text[length] == '+') && length < 40)))
        ++length;
    if (length > 0) return "`" + printable(text.substr(0, length), 40) + "`";
    if (text[0] == '"') return "a string";
    const std::size_t character = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text[0]);
    if (character == 0 || byte < 0x20 || byte == 0x7f) {
        constexpr char digits[] = "0123456789abcdef";
        return std::string("byte 0x") + digits[byte >> 4] + digits[byte & 15];
    }
    return "`" + printable(text.substr(0, character)) + "`";
}

/// After `run` either `fault` is set, or `position` is one past the root value.
class Scanner {
public:
    Scanner(std::string_view source, const std::vector<NodeId>& nodes) : text(source), wanted(nodes) {}
    JsonScan run();

private:
    struct Level {
        bool object = false;
        std::size_t index = 0; ///< of a list's item
        SourceSpan key;        ///< of an object, with quotes
    };

    [[nodiscard]] bool at_end() const { return position >= text.size(); }
    [[nodiscard]] char here() const { return at_end() ? '\0' : text[position]; }
    void skip_space();
    bool fail(std::size_t offset, std::string message, bool with_place = false);
    bool expected(const char* what);
    void note_node(SourceSpan span);
    bool scan_string();
    bool scan_escape();
    bool scan_number();
    bool scan_word();
    bool scan_key();
    bool scan_value();  ///< a scalar whole, of a container the opening bracket
    bool after_value(); ///< commas and closing brackets, up to where the next value starts
    [[nodiscard]] std::string place() const;

    std::string_view text;
    const std::vector<NodeId>& wanted;
    std::vector<SourceSpan> found;
    std::size_t position = 0;
    std::optional<SyntaxFault> fault;
    std::vector<Level> open;
    NodeId node_count = 0;
};

bool Scanner::fail(std::size_t offset, std::string message, bool with_place) {
    fault = SyntaxFault{offset, with_place ? place() : std::string(), std::move(message)};
    return false;
}

bool Scanner::expected(const char* what) {
    return fail(position, std::string("expected ") + what + ", found " + shown(text.substr(std::min(position, text.size()))));
}

std::string Scanner::place() const {
    std::string out;
    for (const Level& level : open)
        out += level.object ? pointer_step(text.substr(level.key.begin + 1, level.key.end - level.key.begin - 2))
                            : "/" + std::to_string(level.index);
    return out;
}

void Scanner::skip_space() {
    while (!at_end() && is_space(text[position])) ++position;
}

void Scanner::note_node(SourceSpan span) {
    while (found.size() < wanted.size() && wanted[found.size()] == node_count) found.push_back(span);
    ++node_count;
}

bool Scanner::scan_escape() {
    const std::size_t start = position;
    const auto code_unit = [&]() -> int { // at `\u`; -1 where there is none
        int value = 0;
        if (text.substr(position, 2) != "\\u") return -1;
        for (std::size_t i = position + 2; i < position + 6; ++i) {
            const char c = i < text.size() ? text[i] : '\0';
            const int digit = is_digit(c)            ? c - '0'
                              : c >= 'a' && c <= 'f' ? c - 'a' + 10
                              : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                     : -1;
            if (digit < 0) return -1;
            value = value * 16 + digit;
        }
        position += 6;
        return value;
    };
    const char kind = position + 1 < text.size() ? text[position + 1] : '\0';
    if (kind != 'u') {
        if (kind == '\0' || std::string_view("\"\\/bfnrt").find(kind) == std::string_view::npos)
            return fail(start, "unknown escape in a string; a backslash itself is written `\\\\`");
        position += 2;
        return true;
    }
    const int unit = code_unit();
    if (unit < 0) return fail(start, "`\\u` must be followed by four hexadecimal digits");
    if (unit >= 0xdc00 && unit <= 0xdfff) return fail(start, "half of a surrogate pair");
    if (unit >= 0xd800 && unit <= 0xdbff) {
        const int second = code_unit();
        if (second < 0xdc00 || second > 0xdfff) return fail(start, "half of a surrogate pair");
    }
    return true;
}

bool Scanner::scan_string() {
    const std::size_t start = position++;
    while (!at_end()) {
        const auto byte = static_cast<unsigned char>(text[position]);
        if (byte == '"') return ++position, true;
        if (byte == '\n' || byte == '\r') return fail(start, "the string does not end on its line");
        if (byte < 0x20) return fail(position, "control character in a string");
        if (byte == '\\') {
            if (!scan_escape()) return false;
        } else if (byte < 0x80) {
            ++position;
        } else {
            const std::size_t length = utf8_length(text.substr(position, 4));
            if (length == 0) return fail(position, "invalid UTF-8 in a string");
            position += length;
        }
    }
    return fail(start, "the string does not end");
}

bool Scanner::scan_number() {
    const std::size_t start = position;
    const auto digits = [&] {
        const std::size_t first = position;
        while (is_digit(here())) ++position;
        return position > first;
    };
    const auto malformed = [&] { return fail(start, "malformed number " + shown(text.substr(start))); };
    if (here() == '-') ++position;
    const bool leading_zero = here() == '0';
    const std::size_t whole = position;
    if (!digits() || (leading_zero && position > whole + 1)) return malformed();
    if (here() == '.' && (++position, !digits())) return malformed();
    if (here() == 'e' || here() == 'E') {
        ++position;
        if (here() == '+' || here() == '-') ++position;
        if (!digits()) return malformed();
    }
    double value = 0;
    const char* at = text.data() + start;
    if (read_number(at, text.data() + position, value) && std::isinf(value)) {
        const std::string digits_text = printable(text.substr(start, position - start), 40);
        return fail(start, "must be a number between -1e30 and 1e30, got " + digits_text, true);
    }
    return true;
}

bool Scanner::scan_word() {
    for (const std::string_view word : {"null", "true", "false"})
        if (text.substr(position, word.size()) == word) return position += word.size(), true;
    return expected("a value");
}

bool Scanner::scan_key() {
    if (here() != '"' || at_end()) return expected("a key in double quotes");
    const std::size_t start = position;
    if (!scan_string()) return false;
    open.back().key = {start, position};
    note_node(open.back().key);
    skip_space();
    if (here() != ':') return expected("`:` after the key");
    ++position;
    return true;
}

bool Scanner::scan_value() {
    skip_space();
    const std::size_t start = position;
    const char c = here();
    if (c == '{' || c == '[') {
        if (open.size() == max_json_depth)
            return fail(start, "nested too deeply: more than " + std::to_string(max_json_depth) + " levels");
        note_node({start, start + 1});
        open.push_back({c == '{', 0, {}});
        ++position;
        return true;
    }
    const bool good = c == '"' ? scan_string() : c == '-' || is_digit(c) ? scan_number() : scan_word();
    if (good) note_node({start, position});
    return good;
}

bool Scanner::after_value() {
    while (!open.empty()) {
        skip_space();
        Level& level = open.back();
        const char close = level.object ? '}' : ']';
        if (here() == close && !at_end()) {
            ++position;
            open.pop_back();
            continue;
        }
        if (here() != ',') return expected(level.object ? "`,` or `}`" : "`,` or `]`");
        ++position;
        ++level.index;
        skip_space();
        return level.object ? scan_key() : true;
    }
    return true;
}

JsonScan Scanner::run() {
    if (text.substr(0, 3) == "\xef\xbb\xbf") position = 3; // byte order mark
    for (bool more = true; more;) {
        const std::size_t depth = open.size();
        more = scan_value();
        if (more && open.size() > depth) {
            skip_space();
            if (here() != (open.back().object ? '}' : ']')) {
                more = !open.back().object || scan_key();
                continue;
            }
        }
        more = more && after_value() && !open.empty();
    }
    return {std::move(found), position, std::move(fault)};
}

} // namespace

JsonScan scan_json(std::string_view text, const std::vector<NodeId>& wanted) { return Scanner(text, wanted).run(); }

} // namespace lanecast
