#include "scene/read_file.hpp"

#include "scene/huge_pages.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lanecast {
namespace {

struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

std::string reason(int error) { return std::generic_category().message(error); }

} // namespace

FileBytes read_file(const std::filesystem::path& file) {
    FileBytes out;
    const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
    struct stat status {};
    if (descriptor.number < 0 || ::fstat(descriptor.number, &status) != 0) return out.fault = reason(errno), std::move(out);
    if (S_ISDIR(status.st_mode)) return out.fault = reason(EISDIR), std::move(out);
    if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) return out.fault = "Not a regular file", std::move(out);

    // One byte more than a regular file holds, so that its end is seen without growing.
    std::size_t room = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : std::size_t{1} << 16;
    out.data = std::make_unique_for_overwrite<char[]>(room);
    prefer_huge_pages(out.data.get(), room);
    for (;;) {
        if (out.size == room) {
            auto larger = std::make_unique_for_overwrite<char[]>(room * 2);
            std::copy_n(out.data.get(), out.size, larger.get());
            out.data = std::move(larger);
            room *= 2;
        }
        const ssize_t got = ::read(descriptor.number, out.data.get() + out.size, room - out.size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return out.fault = reason(errno), std::move(out);
        if (got == 0) return out;
        out.size += static_cast<std::size_t>(got);
    }
}

} // namespace lanecast
