#pragma once
// The errors that end a run. Each carries the exit code the command line documents; only main catches them.

#include <stdexcept>
#include <string>

namespace lanecast {

/// Documented in `lanecast --help` and docs/command-line.md. 8, 75, 130 and 143 are reserved for multi-frame runs.
enum class ExitCode : int {
    done = 0,
    failure = 1, ///< an internal failure, or a comparison that found a difference
    usage = 2,
    scene = 3,
    asset = 4, ///< a mesh file that is missing, unreadable or malformed
    output = 5,
    memory = 6,
    isa = 7, ///< the CPU lacks the requested instruction set
};

class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const noexcept { return code_; }

private:
    ExitCode code_;
};

} // namespace lanecast
