#pragma once
// What --help and --version say, and what a command line that cannot be understood gets.

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace lanecast {

/// Once all commands are there.
void describe_usage(CLI::App& app);

/// Help and version go to the standard output, 0; a fault gets one line, with the nearest option for a typo, 2.
[[nodiscard]] int report_usage(const CLI::App& app, const CLI::ParseError& error);

} // namespace lanecast
