#pragma once
// The look of every message about a text: `file:line:column: error: text`, the source line, a caret.

#include <cstddef>
#include <string>
#include <string_view>

namespace lanecast {

struct LineColumn {
    std::size_t line = 1;
    std::size_t column = 1; ///< in characters (code points), as editors count; a tab is one
};

/// A byte order mark at the start of the text takes no column.
[[nodiscard]] LineColumn line_column(std::string_view text, std::size_t offset);

/// `severity`: "error", "warning" or "note". Three lines without a final line break. A long source line is cut to the
/// surroundings of the place; tabs stay, so that the caret stands below it.
[[nodiscard]] std::string format_diagnostic(std::string_view file, std::string_view text, std::size_t offset,
                                            std::string_view severity, std::string_view message);

} // namespace lanecast
