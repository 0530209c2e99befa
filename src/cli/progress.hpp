#pragma once
// How far a frame is, on the standard error: a bar on a terminal, now and then a line elsewhere, nothing for short frames.

#include <chrono>
#include <cstdint>
#include <string>

namespace lanecast {

/// The text of both: " 42 %", rays per second, time left. `width`: of the bar in characters; 0: no bar.
[[nodiscard]] std::string progress_text(double done, std::uint64_t rays, double seconds, int width, bool color);

/// Erases its bar when it goes.
class ProgressDisplay {
public:
    ProgressDisplay();
    ~ProgressDisplay();
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    /// Share of the tiles done, rays so far; to be called about ten times a second.
    void show(double done, std::uint64_t rays);

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_, last_line_;
    bool terminal_ = false, color_ = false;
    std::size_t drawn_ = 0; ///< characters on the line
};

} // namespace lanecast
