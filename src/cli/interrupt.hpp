#pragma once
// Ctrl-C and SIGTERM. Where nothing is lost by it the process ends at once with 128 + the signal's number, 130 or 143. Where work
// can be put away first, an InterruptScope turns the first signal into a flag; a second one still ends the process.

#include <atomic>

namespace lanecast {

/// Thrown to leave the program; main makes 128 + signal of it.
struct Interrupted {
    int signal;
};

/// SIGINT and SIGTERM as above, unless the caller of the program ignores them; SIGPIPE and SIGXFSZ become errors of the write.
void install_signal_handlers() noexcept;

/// While it lives the first signal only sets stop().
class InterruptScope {
public:
    InterruptScope() noexcept;
    ~InterruptScope();
    InterruptScope(const InterruptScope&) = delete;
    InterruptScope& operator=(const InterruptScope&) = delete;

    [[nodiscard]] const std::atomic<bool>& stop() const noexcept;
    /// Throws Interrupted if a signal came.
    void check() const;
};

} // namespace lanecast
