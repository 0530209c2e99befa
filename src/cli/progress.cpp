#include "cli/progress.hpp"

#include "cli/print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace lanecast {
namespace {

constexpr double bar_delay = 0.5;   // seconds: shorter frames show nothing
constexpr double line_interval = 5; // seconds between plain lines

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != 0;
}

bool draws_bars() {
    const char* const term = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

int columns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// "0:07", "1:02:03".
std::string clock_text(double seconds) {
    const auto s = static_cast<long long>(std::ceil(std::min(seconds, 1e9)));
    char text[48];
    if (s < 3600)
        std::snprintf(text, sizeof text, "%lld:%02lld", s / 60, s % 60);
    else
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
    return text;
}

} // namespace

std::string progress_text(double done, std::uint64_t rays, double seconds, int width, bool color) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "%3d %%", static_cast<int>(100 * done));
    std::string text = percent;
    if (width > 0) {
        const auto full = static_cast<std::size_t>(done * width);
        text += std::string(" [") + (color ? "\x1b[32m" : "") + std::string(full, '#') + (color ? "\x1b[0m" : "") +
                std::string(static_cast<std::size_t>(width) - full, '.') + "]";
    }
    if (seconds > 0) text += "  " + short_count(static_cast<double>(rays) / seconds) + " rays/s";
    if (done > 0) text += "  " + clock_text(seconds / done * (1 - done)) + " left";
    return text;
}

ProgressDisplay::ProgressDisplay()
    : begin_(Clock::now()), last_line_(begin_), terminal_(draws_bars()), color_(terminal_ && !is_set("NO_COLOR")) {}

ProgressDisplay::~ProgressDisplay() {
    if (drawn_ == 0) return;
    const std::string blanks = "\r" + std::string(drawn_, ' ') + "\r";
    std::fwrite(blanks.data(), 1, blanks.size(), stderr);
}

void ProgressDisplay::show(double done, std::uint64_t rays) {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    if (!terminal_) {
        if (std::chrono::duration<double>(now - last_line_).count() < line_interval) return;
        last_line_ = now;
        print_message("rendering: " + progress_text(done, rays, seconds, 0, false));
        return;
    }
    if (seconds < bar_delay) return;
    const std::size_t room = static_cast<std::size_t>(std::max(columns() - 1, 0));
    const std::size_t without_bar = progress_text(done, rays, seconds, 0, false).size();
    const int width = room > without_bar + 13 ? static_cast<int>(std::min<std::size_t>(room - without_bar - 3, 40)) : 0;
    std::string line = progress_text(done, rays, seconds, width, color_);
    const std::size_t visible = std::min(without_bar + (width > 0 ? static_cast<std::size_t>(width) + 3 : 0), room);
    if (width == 0) line.resize(visible);
    line = "\r" + line + std::string(drawn_ > visible ? drawn_ - visible : 0, ' ');
    drawn_ = visible;
    std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace lanecast
