#include "scene/diagnostic.hpp"

#include "scene/text_tools.hpp"

#include <algorithm>

namespace lanecast {
namespace {

constexpr std::size_t widest_line = 120; ///< characters of source shown
constexpr std::size_t lead = 60;         ///< of them before the place, when the line is cut

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }

std::size_t count_characters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

/// The start of the line that holds `offset`, after a byte order mark.
std::size_t line_start(std::string_view text, std::size_t offset) {
    const std::size_t line_break = offset == 0 ? std::string_view::npos : text.rfind('\n', offset - 1);
    if (line_break != std::string_view::npos) return line_break + 1;
    return text.substr(0, 3) == "\xef\xbb\xbf" && offset >= 3 ? 3 : 0;
}

} // namespace

LineColumn line_column(std::string_view text, std::size_t offset) {
    offset = std::min(offset, text.size());
    const std::size_t start = line_start(text, offset);
    const auto breaks = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n');
    return {static_cast<std::size_t>(breaks) + 1, count_characters(text.substr(start, offset - start)) + 1};
}

std::string format_diagnostic(std::string_view file, std::string_view text, std::size_t offset, std::string_view severity,
                              std::string_view message) {
    offset = std::min(offset, text.size());
    const std::size_t start = line_start(text, offset);
    std::size_t end = std::min(text.find('\n', offset), text.size());
    if (end > start && end > offset && text[end - 1] == '\r') --end;
    const LineColumn at = line_column(text, offset);

    // Cut by bytes, then moved back to the start of a character, which has at most four.
    const auto character_start = [&](std::size_t cut, std::size_t low) {
        for (int i = 0; i < 3 && cut > low && cut < end && !starts_character(text[cut]); ++i) --cut;
        return cut;
    };
    std::size_t first = start;
    std::size_t last = end;
    if (end - start > widest_line) {
        first = offset - start > lead ? character_start(offset - lead, start) : start;
        last = character_start(std::min(end, first + widest_line), offset);
    }
    const auto shown = [&](std::size_t from, std::size_t to) {
        std::string out;
        while (from < to) {
            const std::size_t length = std::max<std::size_t>(1, utf8_length(text.substr(from, to - from)));
            out += text[from] == '\t' ? "\t" : printable(text.substr(from, length));
            from += length;
        }
        return out;
    };
    std::string before(first > start ? "..." : "");
    before += shown(first, offset);
    std::string caret;
    for (const char c : before)
        if (starts_character(c)) caret += c == '\t' ? '\t' : ' ';

    std::string out(file);
    out.append(":").append(std::to_string(at.line)).append(":").append(std::to_string(at.column)).append(": ");
    out.append(severity).append(": ").append(message).append("\n");
    out.append(before).append(shown(offset, last)).append(last < end ? "..." : "").append("\n");
    return out.append(caret).append("^");
}

} // namespace lanecast
