#include "render/output_file.hpp"

#include "scene/text_tools.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lanecast {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18; // few system calls, and small beside any film

[[nodiscard]] Error output_error(const std::filesystem::path& path, const std::string& reason) {
    return {ExitCode::output, printable_path(path) + ": cannot write: " + reason};
}

[[nodiscard]] std::string reason_of(int error_number) { return std::generic_category().message(error_number); }

/// The file to replace, and its permissions; those of a new file if there is none.
struct Target {
    std::filesystem::path path;
    mode_t mode = 0;
    bool exists = false;
};

/// Where a chain of symbolic links leads that ends at no file. One that leads in a circle is left to `stat`.
[[nodiscard]] std::filesystem::path follow_links(std::filesystem::path path) {
    std::error_code error;
    for (int links = 0; links < 40 && std::filesystem::is_symlink(path, error); ++links)
        path = path.parent_path() / std::filesystem::read_symlink(path, error);
    return path;
}

[[nodiscard]] Target resolve_target(const std::filesystem::path& path) {
    if (path.empty()) throw output_error(path, "the file name is empty");
    std::error_code error;
    const std::filesystem::path canonical = std::filesystem::canonical(path, error);
    Target target{error ? follow_links(path) : canonical};
    struct stat status {};
    if (::stat(target.path.c_str(), &status) != 0) {
        if (errno == ENOENT && path.has_filename()) {
            const std::filesystem::path directory = target.path.has_parent_path() ? target.path.parent_path() : ".";
            if (!std::filesystem::exists(directory, error))
                throw output_error(path, "the directory " + printable_path(directory) + " does not exist");
            return target;
        }
        throw output_error(path, reason_of(errno));
    }
    if (S_ISDIR(status.st_mode)) throw output_error(path, reason_of(EISDIR));
    // Renaming over a device or a pipe would replace the thing itself.
    if (!S_ISREG(status.st_mode)) throw output_error(path, "it exists and is not a regular file");
    // A rename needs no permission on the file it replaces, but whoever made it read-only meant something.
    if (::faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) throw output_error(path, reason_of(errno));
    target.exists = true;
    target.mode = status.st_mode & 07777;
    return target;
}

/// Unique in this directory by O_EXCL, whatever the host that shares it. Keeps to 255 bytes whatever the target's name.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target) {
    static std::atomic<unsigned> counter{0};
    std::string name = ".";
    name += target.filename().string().substr(0, 200);
    name += ".lanecast-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ".tmp";
    return target.parent_path() / name;
}

} // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path) {
    const Target target = resolve_target(path);
    target_ = target.path;
    buffer_ = std::make_unique<unsigned char[]>(buffer_size);
    do {
        temporary_ = temporary_name(target_);
        fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (fd_ < 0 && (errno == EEXIST || errno == EINTR));
    if (fd_ < 0) throw output_error(path, reason_of(errno));
    // Where the file system knows no modes this fails, and there is nothing to keep.
    if (target.exists) static_cast<void>(::fchmod(fd_, target.mode));
}

OutputFile::~OutputFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool OutputFile::write_through(const unsigned char* data, std::size_t size) noexcept {
    while (size > 0) {
        const ssize_t written = ::pwrite(fd_, data, size, static_cast<off_t>(buffer_position_));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            errno_ = written < 0 ? errno : ENOSPC;
            return false;
        }
        data += written;
        size -= static_cast<std::size_t>(written);
        buffer_position_ += static_cast<std::uint64_t>(written);
    }
    return true;
}

bool OutputFile::flush() noexcept {
    if (failed()) return false;
    const std::size_t size = buffered_;
    buffered_ = 0;
    return write_through(buffer_.get(), size);
}

bool OutputFile::write(const void* data, std::size_t size) noexcept {
    if (failed()) return false;
    if (size > buffer_size - buffered_ && !flush()) return false;
    if (size > buffer_size) return write_through(static_cast<const unsigned char*>(data), size);
    std::memcpy(buffer_.get() + buffered_, data, size);
    buffered_ += size;
    return true;
}

bool OutputFile::seek(std::uint64_t position) noexcept {
    if (!flush()) return false;
    buffer_position_ = position;
    return true;
}

Error OutputFile::error() const { return output_error(path_, reason_of(errno_)); }

void OutputFile::complete() {
    if (!flush()) throw error();
    // Some file systems make a rename durable before the data it names: a power cut would leave an empty file. Measured: 1 to 13
    // ms for 2 MB. Errors of a delayed allocation come here too; a file system that cannot sync says EINVAL.
    if (::fdatasync(fd_) != 0 && errno != EINVAL && errno != EINTR) errno_ = errno;
    // close() is where network file systems report a full disk.
    const int closed = ::close(fd_);
    fd_ = -1;
    if (closed != 0 && errno != EINTR && !failed()) errno_ = errno;
    if (failed()) throw error();
}

void OutputFile::commit() {
    if (fd_ >= 0) complete();
    if (!failed() && ::rename(temporary_.c_str(), target_.c_str()) != 0) errno_ = errno;
    if (failed()) throw error();
    temporary_.clear();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
    OutputFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

} // namespace lanecast
