#pragma once
// A place in an OBJ or MTL text, which consist of lines of words. A backslash at the end of a line continues it.

#include "scene/diagnostic.hpp"
#include "scene/error.hpp"
#include "scene/read_number.hpp"
#include "scene/scene_format.hpp"
#include "scene/text_tools.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace lanecast {

struct TextCursor {
    std::string_view text;
    const std::string& name;
    const char* at = text.data();
    const char* end = text.data() + text.size();

    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
    static bool is_space(char c) { return is_blank(c) || c == '\n'; }

    void skip_blanks() {
        for (; at != end; ++at) {
            if (is_blank(*at)) continue;
            if (*at != '\\') return;
            const char* after = at + 1;
            if (after != end && *after == '\r') ++after;
            if (after == end || *after != '\n') return;
            at = after;
        }
    }
    /// After blanks: whether the statement is over.
    bool at_statement_end() {
        skip_blanks();
        return at == end || *at == '\n' || *at == '#';
    }
    /// To the start of the next line that continues nothing.
    void skip_statement() {
        for (bool comment = false; at != end; ++at) {
            comment = comment || *at == '#';
            if (*at == '\\' && !comment) skip_blanks();
            if (at == end) return;
            if (*at == '\n') {
                ++at;
                return;
            }
        }
    }
    std::string_view word() {
        skip_blanks();
        const char* const start = at;
        while (at != end && !is_space(*at)) ++at;
        return {start, static_cast<std::size_t>(at - start)};
    }
    /// What is left of the line, without blanks around it: names may contain blanks.
    std::string_view rest_of_line() {
        skip_blanks();
        const char* const start = at;
        while (at != end && *at != '\n') ++at;
        const char* last = at;
        while (last != start && is_blank(last[-1])) --last;
        return {start, static_cast<std::size_t>(last - start)};
    }
    /// A number that ends its word, of magnitude 1e30 at most.
    double number(const char* what) {
        skip_blanks();
        const char* const start = at;
        double value = 0;
        if (!read_number(at, end, value) || (at != end && !is_space(*at))) fail_word(start, what);
        if (!(std::abs(value) <= largest_magnitude)) fail_word(start, "a number between -1e30 and 1e30");
        return value;
    }
    [[noreturn]] void fail_word(const char* start, const std::string& what) {
        at = start;
        const std::string_view found = word();
        fail(start, "must be " + what + ", got " + (found.empty() ? "the end of the line" : "`" + printable(found, 40) + "`"));
    }
    [[nodiscard]] std::string message(const char* place, const char* severity, const std::string& what) const {
        return format_diagnostic(name, text, static_cast<std::size_t>(place - text.data()), severity, what);
    }
    [[noreturn]] void fail(const char* place, const std::string& what) const {
        throw Error(ExitCode::asset, message(place, "error", what));
    }
};

} // namespace lanecast
