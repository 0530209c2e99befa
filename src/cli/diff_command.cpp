// lanecast diff on the command line; diff.hpp does the work.

#include "cli/commands.hpp"
#include "cli/diff.hpp"
#include "cli/interrupt.hpp"
#include "cli/number_option.hpp"
#include "cli/print.hpp"

#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>

namespace lanecast {
namespace {

constexpr KeySpec limit_key{.name = "limit", .range = {.low = 0}};
constexpr KeySpec share_key{.name = "share", .range = {.low = 0, .high = 1}};

} // namespace

void add_diff(CLI::App& app, Command& chosen) {
    CLI::App* const command = app.add_subcommand("diff", "Compare two pictures, EXR or PNG: 0 if they are the same");
    const auto options = std::make_shared<DiffOptions>();
    DiffOptions& o = *options;
    command->add_option("a", o.a, "A picture")->required()->type_name("FILE");
    command->add_option("b", o.b, "Another")->required()->type_name("FILE");
    command->add_option("-o,--output", o.output, "Difference picture, .exr or .png")->type_name("FILE");
    add_number_option(*command, "--scale", "Of the difference picture; default 1 for EXR, 16 for PNG", limit_key,
                      [&o](double v) { o.scale = static_cast<float>(v); });
    add_number_option(*command, "--threshold", "A pixel is off when a channel differs by more; default 1/255", limit_key,
                      [&o](double v) { o.threshold = v; });
    add_number_option(*command, "--max-rmse", "Accept this root of the mean square", limit_key,
                      [&o](double v) { o.max_rmse = v; });
    add_number_option(*command, "--max-error", "Accept this difference of a channel", limit_key,
                      [&o](double v) { o.max_error = v; });
    add_number_option(*command, "--max-off-share", "Accept this share of pixels that are off, 0 to 1", share_key,
                      [&o](double v) { o.max_off_share = v; });
    command->final_callback([&chosen, options] {
        chosen = [options] {
            std::ostringstream out;
            const InterruptScope interrupt; // the difference picture is written whole, or its temporary file removed
            const int code = run_diff(*options, out);
            interrupt.check();
            print_result(out.str());
            return code;
        };
    });
}

} // namespace lanecast
