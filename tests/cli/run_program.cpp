#include "cli/run_program.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lanecast::test {
namespace {

struct Pipe {
    int read_end = -1, write_end = -1;
};

Pipe make_pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return {ends[0], ends[1]};
}

Pipe make_terminal() {
    Pipe ends;
    winsize size{.ws_row = 30, .ws_col = 100, .ws_xpixel = 0, .ws_ypixel = 0};
    if (::openpty(&ends.read_end, &ends.write_end, nullptr, nullptr, &size) != 0) throw std::runtime_error("no terminal");
    ::fcntl(ends.read_end, F_SETFD, FD_CLOEXEC);
    ::fcntl(ends.write_end, F_SETFD, FD_CLOEXEC);
    return ends;
}

void limit(int resource, std::size_t bytes) {
    const rlimit limits{bytes, bytes};
    if (bytes > 0) ::setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

/// Of the child, which is single-threaded: everything it needs is at hand.
[[noreturn]] void become_program(char* const* arguments, const RunOptions& options, int out, int err) {
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (!options.out_file.empty()) ::dup2(::open(options.out_file.c_str(), O_WRONLY), STDOUT_FILENO);
    if (::chdir(options.directory.c_str()) != 0) ::_exit(126);
    for (const std::string& variable : options.environment) ::putenv(const_cast<char*>(variable.c_str()));
    if (options.one_cpu) {
        cpu_set_t set;
        ::sched_getaffinity(0, sizeof set, &set);
        int cpu = 0;
        while (!CPU_ISSET(cpu, &set)) ++cpu;
        CPU_ZERO(&set);
        CPU_SET(cpu, &set);
        ::sched_setaffinity(0, sizeof set, &set);
    }
    limit(RLIMIT_AS, options.address_space);
    limit(RLIMIT_FSIZE, options.file_size);
    ::execv(arguments[0], arguments);
    ::_exit(127);
}

/// False at the end of the stream.
bool read_some(int fd, std::string& text) {
    char buffer[4096];
    const ssize_t got = ::read(fd, buffer, sizeof buffer);
    if (got > 0) text.append(buffer, static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR); // a terminal that was closed is EIO
}

} // namespace

Outcome run(const std::vector<std::string>& arguments, const RunOptions& options) {
    std::vector<std::string> words{options.program.empty() ? LANECAST_PROGRAM : options.program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const Pipe out = make_pipe(), err = options.terminal ? make_terminal() : make_pipe();
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) become_program(pointers.data(), options, out.write_end, err.write_end);
    ::close(out.write_end);
    ::close(err.write_end);

    Outcome outcome;
    bool out_open = true, err_open = true, signalled = options.signal_at.empty();
    auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(options.seconds);
    while (out_open || err_open) {
        pollfd ends[] = {{out_open ? out.read_end : -1, POLLIN, 0}, {err_open ? err.read_end : -1, POLLIN, 0}};
        ::poll(ends, 2, 100);
        if (ends[0].revents != 0) out_open = read_some(out.read_end, outcome.out);
        if (ends[1].revents != 0) err_open = read_some(err.read_end, outcome.err);
        if (!signalled && outcome.err.find(options.signal_at) != std::string::npos) {
            ::kill(child, options.signal);
            signalled = true;
            deadline = std::chrono::steady_clock::now() + std::chrono::seconds(options.seconds_after);
        }
        if (std::chrono::steady_clock::now() > deadline) ::kill(child, SIGKILL);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ::close(out.read_end);
    ::close(err.read_end);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return outcome;
}

bool have_terminals() {
    int terminal = -1, program = -1;
    if (::openpty(&terminal, &program, nullptr, nullptr, nullptr) != 0) {
        std::puts("skipped: no pseudo-terminals on this machine");
        return false;
    }
    ::close(terminal);
    ::close(program);
    return true;
}

std::filesystem::path small_scene() { return std::filesystem::path(LANECAST_SOURCE_DIR) / "tests/cli/small.json"; }

} // namespace lanecast::test
