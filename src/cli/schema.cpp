// lanecast schema: the JSON Schema of scenes, for editors.

#include "scene/schema.hpp"
#include "cli/commands.hpp"
#include "cli/print.hpp"

#include <CLI/CLI.hpp>

namespace lanecast {

void add_schema(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("schema", "Print the JSON Schema of scenes, for completion in editors");
    command->final_callback([&chosen] {
        chosen = [] {
            print_result(scene_schema());
            return 0;
        };
    });
}

} // namespace lanecast
