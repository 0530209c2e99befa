// The program: parses the command line, runs the command and turns whatever it throws into a message and an exit code.

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/print.hpp"
#include "cli/settings_options.hpp"
#include "cli/usage.hpp"
#include "scene/error.hpp"

#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

using namespace lanecast;

int run(int argc, char** argv) {
    CLI::App app{"Lanecast: a SIMD-packet Whitted ray tracer. JSON scene in, EXR and PNG out.", "lanecast"};
    Command command;
    add_render(app, command);
    add_check(app, command);
    add_info(app, command);
    add_pick(app, command);
    add_diff(app, command);
    add_bench(app, command);
    add_measure(app, command);
    add_selftest(app, command);
    add_schema(app, command);
    describe_usage(app);
    try {
        std::vector<std::string> arguments = join_bvh_words(argc, argv);
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        app.parse(static_cast<int>(pointers.size()), pointers.data());
    } catch (const CLI::ParseError& error) {
        return report_usage(app, error);
    }
    return command();
}

/// Messages about a file already say `file: error: what`.
int fail(ExitCode code, const std::string& message) {
    print_message(message.find("error: ") != std::string::npos ? message : "lanecast: error: " + message);
    return static_cast<int>(code);
}

} // namespace

int main(int argc, char** argv) {
    install_signal_handlers();
    try {
        return run(argc, argv);
    } catch (const Error& error) {
        return fail(error.code(), error.what());
    } catch (const Interrupted& interrupted) {
        print_message("lanecast: interrupted; no picture was written");
        return 128 + interrupted.signal;
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::memory, "out of memory");
    } catch (const std::system_error& error) {
        // a thread that could not be started is a limit of the machine, too
        const bool limit = error.code() == std::errc::resource_unavailable_try_again;
        return fail(limit ? ExitCode::memory : ExitCode::failure, error.what());
    } catch (const std::exception& error) {
        return fail(ExitCode::failure, error.what());
    } catch (...) {
        return fail(ExitCode::failure, "unknown exception");
    }
}
