#pragma once
// The commands of the program. Each function adds one to the command line and, where the user chose it, says what runs it.

#include <functional>

namespace CLI {
class App;
}

namespace lanecast {

using Command = std::function<int()>; ///< returns the exit code; throws Error, Interrupted, std::bad_alloc

void add_render(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_pick(CLI::App& app, Command& chosen);
void add_diff(CLI::App& app, Command& chosen);
void add_bench(CLI::App& app, Command& chosen);
void add_measure(CLI::App& app, Command& chosen);
void add_selftest(CLI::App& app, Command& chosen);
void add_schema(CLI::App& app, Command& chosen);

} // namespace lanecast
