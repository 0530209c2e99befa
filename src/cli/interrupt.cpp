#include "cli/interrupt.hpp"

#include <csignal>

#include <unistd.h>

namespace lanecast {
namespace {

std::atomic<bool> deferred{false}, stop_flag{false};
std::atomic<int> received{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void lanecast_on_signal(int signal) {
    if (!deferred.load() || stop_flag.load()) ::_exit(128 + signal);
    received.store(signal);
    stop_flag.store(true);
}

void handle(int signal) noexcept {
    struct sigaction action {};
    // A background job of a script, or nohup: whoever ignored the signal for us meant it.
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_handler = lanecast_on_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
}

} // namespace

void install_signal_handlers() noexcept {
    handle(SIGINT);
    handle(SIGTERM);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

InterruptScope::InterruptScope() noexcept { deferred.store(true); }
InterruptScope::~InterruptScope() { deferred.store(false); }
const std::atomic<bool>& InterruptScope::stop() const noexcept { return stop_flag; }
void InterruptScope::check() const {
    if (stop_flag.load()) throw Interrupted{received.load()};
}

} // namespace lanecast
