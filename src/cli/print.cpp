#include "cli/print.hpp"

#include "scene/error.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <system_error>

#include <unistd.h>

namespace lanecast {
namespace {

/// 0 or the errno of the fault.
int write_all(int fd, std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t written = ::write(fd, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

struct Unit {
    double size;
    const char* name;
};

/// Three digits of value / size of the largest unit that is not larger than it.
template <std::size_t n>
std::string in_units(double value, const Unit (&units)[n]) {
    const Unit* unit = units;
    while (unit + 1 != units + n && std::abs(value) < 0.9995 * unit->size) ++unit;
    const double x = value / unit->size;
    const int decimals = x == std::floor(x) && unit->name[0] == 0 ? 0 : std::abs(x) < 9.995 ? 2 : std::abs(x) < 99.95 ? 1 : 0;
    return fixed(x, decimals) + (unit->name[0] == 0 ? "" : " ") + unit->name;
}

} // namespace

void print_result(std::string_view text) {
    const int fault = write_all(STDOUT_FILENO, text);
    if (fault != 0 && fault != EPIPE)
        throw Error(ExitCode::output, "standard output: cannot write: " + std::generic_category().message(fault));
}

void print_message(std::string_view line) noexcept {
    try {
        static_cast<void>(write_all(STDERR_FILENO, std::string(line) + "\n"));
    } catch (...) { // no memory for the copy
        static_cast<void>(write_all(STDERR_FILENO, line));
    }
}

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string counted(std::size_t count, const std::string& noun) {
    const bool sibilant = noun.ends_with('s') || noun.ends_with('h');
    return std::to_string(count) + " " + noun + (count == 1 ? "" : sibilant ? "es" : "s");
}

std::string short_count(double value) {
    static constexpr Unit units[] = {{1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}};
    return in_units(value, units);
}

std::string short_error(double error) {
    char text[32];
    std::snprintf(text, sizeof text, error != 0 && error < 1e-3 ? "%.2e" : "%.3g", error);
    return text;
}

std::string short_seconds(double seconds) {
    static constexpr Unit units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}};
    return in_units(seconds, units);
}

std::string short_bytes(double bytes) {
    static constexpr Unit units[] = {{0x1p40, "TiB"}, {0x1p30, "GiB"}, {0x1p20, "MiB"}, {0x1p10, "KiB"}, {1, "B"}};
    return in_units(bytes, units);
}

} // namespace lanecast
