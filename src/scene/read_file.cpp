#include "scene/read_file.hpp"

#include "scene/huge_pages.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lanecast {
namespace {

constexpr int writer_milliseconds = 5000; ///< how long a pipe may have no writer at first

struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

std::string reason(int error) { return std::generic_category().message(error); }

/// Until there is something to read, or the last writer is gone. False after the time.
bool wait(int descriptor, int milliseconds) {
    pollfd event{descriptor, POLLIN, 0};
    return ::poll(&event, 1, milliseconds) != 0;
}

FileBytes read(const std::filesystem::path& file, bool pipe_allowed) {
    FileBytes out;
    // Opening a pipe, and reading it, would otherwise block for as long as nobody has it open for writing.
    const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    struct stat status {};
    if (descriptor.number < 0 || ::fstat(descriptor.number, &status) != 0) return out.fault = reason(errno), std::move(out);
    const bool is_pipe = pipe_allowed && S_ISFIFO(status.st_mode);
    if (S_ISDIR(status.st_mode)) return out.fault = reason(EISDIR), std::move(out);
    if (!S_ISREG(status.st_mode) && !is_pipe) return out.fault = "Not a regular file", std::move(out);

    // One byte more than a regular file holds, so that its end is seen without growing.
    std::size_t room = is_pipe ? std::size_t{1} << 16 : static_cast<std::size_t>(status.st_size) + 1;
    out.data = std::make_unique_for_overwrite<char[]>(room);
    prefer_huge_pages(out.data.get(), room);
    bool written = !is_pipe; // a pipe without a writer reads as if it had ended, before the first one as after the last
    for (bool waited = false;;) {
        if (out.size == room) {
            auto larger = std::make_unique_for_overwrite<char[]>(room * 2);
            std::copy_n(out.data.get(), out.size, larger.get());
            out.data = std::move(larger);
            room *= 2;
        }
        const ssize_t got = ::read(descriptor.number, out.data.get() + out.size, room - out.size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0 && errno == EAGAIN) { // there is a writer, but nothing yet
            written = true;
            wait(descriptor.number, -1);
        } else if (got < 0) {
            return out.fault = reason(errno), std::move(out);
        } else if (got > 0) {
            out.size += static_cast<std::size_t>(got);
            written = true;
        } else if (written) {
            return out;
        } else if (waited) {
            return out.fault = "No program writes to this pipe", std::move(out);
        } else {
            written = wait(descriptor.number, writer_milliseconds);
            waited = true; // a writer that has written nothing yet shows at the next read
        }
    }
}

} // namespace

FileBytes read_file(const std::filesystem::path& file) { return read(file, false); }
FileBytes read_file_or_pipe(const std::filesystem::path& file) { return read(file, true); }

} // namespace lanecast
