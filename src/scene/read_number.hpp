#pragma once
// Decimal numbers in text files, by std::from_chars: fast, exact and the same in every locale.

#include <charconv>
#include <limits>
#include <string_view>
#include <system_error>

namespace lanecast {

/// Whether a decimal number that from_chars calls out of range is too large; else it is too small and means 0.
[[nodiscard]] bool is_overflow(std::string_view number);

/// Reads a number at `at` and moves past it. Overflow gives an infinity, underflow 0. False where there is no number.
[[nodiscard]] inline bool read_number(const char*& at, const char* end, double& value) {
    const char* const start = at != end && *at == '+' ? at + 1 : at;
    const std::from_chars_result parsed = std::from_chars(start, end, value);
    if (parsed.ec == std::errc::invalid_argument) return false;
    if (parsed.ec == std::errc::result_out_of_range)
        value =
            is_overflow({start, static_cast<std::size_t>(parsed.ptr - start)}) ? std::numeric_limits<double>::infinity() : 0.0;
    at = parsed.ptr;
    return true;
}

} // namespace lanecast
