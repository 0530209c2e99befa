// What a frame shows while it is rendered, on terminals and elsewhere.
#include "cli/run_program.hpp"
#include "render/output_support.hpp"

#include <doctest/doctest.h>

using namespace lanecast::test;

namespace {

const std::string small = small_scene().string();

/// A frame that would take hours, stopped once `text` is shown.
Outcome until(const std::string& text, RunOptions options) {
    const TemporaryDirectory directory;
    options.directory = directory.path;
    options.signal_at = text;
    return run({"render", small, "-o", "a", "--size", "8192x8192", "--aa", "grid", "--aa-samples", "16"}, options);
}

} // namespace

TEST_CASE("a terminal gets a bar with rays per second and time left, which is erased") {
    if (!have_terminals()) return;
    const Outcome outcome = until("left", {.environment = {"TERM=xterm", "NO_COLOR="}, .terminal = true});
    CHECK(outcome.code == 130);
    CHECK(contains(outcome.err, "\r  0 % [\x1b[32m"));
    CHECK(contains(outcome.err, " rays/s  "));
    // What follows the bar is blanks over its whole length, then the message on a clean line.
    const std::size_t message = outcome.err.rfind("\rlanecast: interrupted");
    REQUIRE(message != std::string::npos);
    const std::size_t blanks = outcome.err.rfind('\r', message - 1);
    CHECK(outcome.err.substr(blanks + 1, message - blanks - 1).find_first_not_of(' ') == std::string::npos);
    CHECK(message - blanks > 60);
}

TEST_CASE("NO_COLOR: the bar without an escape sequence") {
    if (!have_terminals()) return;
    const Outcome outcome = until("left", {.environment = {"TERM=xterm", "NO_COLOR=1"}, .terminal = true});
    CHECK(contains(outcome.err, "\r  0 % [...."));
    CHECK(!contains(outcome.err, "\x1b"));
}

TEST_CASE("a dumb terminal, like a file, gets plain lines now and then") {
    for (const bool terminal : {true, false}) {
        CAPTURE(terminal);
        if (terminal && !have_terminals()) continue;
        const Outcome outcome = until("left", {.environment = {"TERM=dumb"}, .terminal = terminal});
        CHECK(outcome.code == 130);
        CHECK(!contains(outcome.err, "\x1b"));
        const std::size_t line = outcome.err.find("rendering:   "); // one digit, whatever the machine's speed
        REQUIRE(line != std::string::npos);
        CHECK(outcome.err.substr(line + 14, 4) == " %  ");
        std::string text = outcome.err; // a terminal's line ends are \r\n
        for (std::size_t at = 0; (at = text.find("\r\n", at)) != std::string::npos;) text.erase(at, 1);
        CHECK(!contains(text, "\r"));
    }
}

TEST_CASE("a short frame shows no progress, only what was written; --quiet nothing at all") {
    const TemporaryDirectory directory;
    for (const bool terminal : {true, false}) {
        if (terminal && !have_terminals()) continue;
        const RunOptions options{.directory = directory.path, .environment = {"TERM=xterm"}, .terminal = terminal};
        Outcome outcome = run({"render", small, "-o", "a", "--size", "16x16"}, options);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.empty());
        CHECK(contains(outcome.err, "wrote a.exr and a.png (16x16, "));
        CHECK(!contains(outcome.err, "%"));
        CHECK(!contains(outcome.err, "\x1b"));
        outcome = run({"render", small, "-o", "a", "--size", "16x16", "--quiet"}, options);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.empty()); // not even the warning
    }
}
