#include "cli/usage.hpp"

#include "cli/print.hpp"
#include "scene/error.hpp"
#include "scene/text_tools.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

constexpr const char* exit_codes = R"(Exit codes:
  0    done
  1    diff found a difference, selftest a missed target, bench --features another pixel; or an internal failure
  2    wrong usage of the command line, or no settings keep --max-error or --max-time
  3    the scene cannot be read or is not valid
  4    a mesh or a picture cannot be read or is not valid
  5    an output cannot be written
  6    not enough memory
  7    this CPU or this build lacks the instruction set, or the peer of selftest
  130  interrupted (Ctrl-C); 143 by SIGTERM: no picture was written or changed
)";

/// CLI11 shows --x,--no-x{false}.
class Formatter : public CLI::Formatter {
public:
    std::string make_option_name(const CLI::Option* option, bool positional) const override {
        std::string name = CLI::Formatter::make_option_name(option, positional);
        for (const std::string_view mark : {"{false}"})
            if (const std::size_t at = name.find(mark); at != std::string::npos) name.erase(at, mark.size());
        return name;
    }
};

const CLI::App& chosen_command(const CLI::App& app) {
    const std::vector<const CLI::App*> chosen = app.get_subcommands([](const CLI::App* command) { return command->parsed(); });
    return chosen.empty() ? app : *chosen.front();
}

std::string full_name(const CLI::App& app, const CLI::App& command) {
    return &app == &command ? app.get_name() : app.get_name() + " " + command.get_name();
}

/// The option or command nearest to what was not understood; empty where nothing is near.
std::string nearest(const CLI::App& command, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_fnames()) names.push_back("--" + name);
    }
    for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) names.push_back(sub->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    return std::string(nearest_word(word.substr(0, word.find('=')), known));
}

std::string explanation(const CLI::App& command, const CLI::ParseError& error) {
    const auto extras = command.remaining();
    const bool no_command = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && command.get_parent() == nullptr;
    if (extras.empty() && no_command) return "a command is required: render, check, info, pick, diff, bench, measure, selftest or schema";
    const bool not_known = no_command || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    if (extras.empty() || !not_known) return error.what();
    const std::string near = nearest(command, extras.front());
    return "'" + printable(extras.front()) + "' is not known here" + (near.empty() ? "" : "; did you mean '" + near + "'?");
}

} // namespace

void describe_usage(CLI::App& app) {
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("lanecast ") + LANECAST_VERSION);
    app.footer(exit_codes);
    const auto formatter = std::make_shared<Formatter>();
    formatter->column_width(40);
    app.formatter(formatter);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        command->formatter(formatter);
        command->footer(exit_codes);
    }
}

int report_usage(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = chosen_command(app);
    if (dynamic_cast<const CLI::CallForHelp*>(&error) != nullptr) {
        print_result(command.help(&command == &app ? "" : app.get_name()));
        return 0;
    }
    if (dynamic_cast<const CLI::CallForVersion*>(&error) != nullptr) {
        print_result(std::string(error.what()) + "\n");
        return 0;
    }
    const std::string name = full_name(app, command);
    print_message(name + ": error: " + explanation(command, error) + "\nTry '" + name + " --help'.");
    return static_cast<int>(ExitCode::usage);
}

} // namespace lanecast
