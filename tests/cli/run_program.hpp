#pragma once
// Runs the real program and watches it.

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lanecast::test {

struct RunOptions {
    std::filesystem::path program{};        ///< a copy of it; empty: where it was built
    std::filesystem::path directory = ".";  ///< it runs there
    std::vector<std::string> environment{}; ///< NAME=value, beside what the test has
    std::string out_file{};                 ///< its standard output; empty: Outcome::out
    bool terminal = false;                  ///< its standard error is a terminal, 100 columns wide
    bool one_cpu = false;                   ///< it may use one CPU
    std::size_t address_space = 0;          ///< limits in bytes; 0: none
    std::size_t file_size = 0;
    std::string signal_at{}; ///< once this text is on its standard error ...
    int signal = SIGINT;     ///< ... it gets this signal
    int seconds = 60;        ///< then it is killed
    int seconds_after = 20;  ///< of the signal, then too
};

struct Outcome {
    int code = 0; ///< exit code; minus the signal that killed it
    std::string out, err;
};

[[nodiscard]] Outcome run(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Whether this machine has pseudo-terminals (a bare chroot has none); says so by name when it has not.
[[nodiscard]] bool have_terminals();

/// The scene that has a little of everything.
[[nodiscard]] std::filesystem::path small_scene();

} // namespace lanecast::test
