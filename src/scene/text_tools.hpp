#pragma once
// Small helpers for showing a user's own text back to them.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lanecast {

/// Length of the well-formed UTF-8 sequence at the start of `text`; 0 where there is none.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Safe to print: control characters and malformed UTF-8 become '?', and text beyond `limit` bytes becomes "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t limit = 60);

/// The same of a file name, whole; an empty one shows as ''.
[[nodiscard]] std::string printable_path(const std::filesystem::path& path);

/// A to Z become a to z.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The word of `known` nearest to `word` by edits (a swap of neighbours counts one, and so does a word cut short), if it is
/// near enough to be meant; else empty.
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// The shortest decimal text that reads back as `value`; whole numbers without an exponent.
[[nodiscard]] std::string number_text(double value);

} // namespace lanecast
