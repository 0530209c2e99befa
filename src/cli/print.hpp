#pragma once
// What the program says: results on the standard output, everything else on the standard error.

#include <cstddef>
#include <string>
#include <string_view>

namespace lanecast {

/// All of it, or Error (output). A reader that went away (`| head`) is no error: the rest is dropped.
void print_result(std::string_view text);

/// A line of its own; faults are ignored, since there is nobody to tell.
void print_message(std::string_view line) noexcept;

/// `value` with `decimals` digits after the point.
[[nodiscard]] std::string fixed(double value, int decimals);
/// "1 light", "2 lights".
[[nodiscard]] std::string counted(std::size_t count, const std::string& noun);
/// "12.3 M", of counts and rates: three digits and a power of a thousand.
[[nodiscard]] std::string short_count(double value);
/// "1.23 s", "45.6 ms", "7.89 us".
[[nodiscard]] std::string short_seconds(double seconds);
/// "0.0123", "4.56e-05": three digits.
[[nodiscard]] std::string short_error(double error);
/// "12.3 MiB".
[[nodiscard]] std::string short_bytes(double bytes);

} // namespace lanecast
