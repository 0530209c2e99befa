#pragma once
// A file that appears whole or not at all. It is written under a temporary name beside the target, `.<name>.lanecast-<pid>-
// <n>.tmp`, and renamed by commit(); a file that was there before stays as it was until then.

#include "scene/error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace lanecast {

/// Owns the descriptor and the temporary file: both go with it, unless commit() renamed the file before.
class OutputFile {
public:
    /// Creates the temporary file. Throws Error (output) where the target could not be replaced: missing directory, no
    /// permission, a directory, a device. A symbolic link is followed: what it points to is replaced.
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// False from the first failure on; commit() says why. Does not throw, so C libraries may call it.
    bool write(const void* data, std::size_t size) noexcept;
    bool seek(std::uint64_t position) noexcept;
    [[nodiscard]] std::uint64_t position() const noexcept { return buffer_position_ + buffered_; }

    [[nodiscard]] bool failed() const noexcept { return errno_ != 0; }
    /// What to throw once failed(): names the file and the reason.
    [[nodiscard]] Error error() const;

    /// Everything is on the disk when this returns; throws error() if anything failed. Of several files that belong together
    /// all are completed before the first is committed. No write after it.
    void complete();
    /// Completes the file if need be and renames it to the target; throws error(). Last call but the destructor.
    void commit();

    /// As the caller named it.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

private:
    bool flush() noexcept;
    bool write_through(const unsigned char* data, std::size_t size) noexcept;

    std::filesystem::path path_;      ///< as the caller named it, for messages
    std::filesystem::path target_;    ///< with symbolic links resolved
    std::filesystem::path temporary_; ///< empty once renamed
    int fd_ = -1;
    int errno_ = 0; ///< of the first failure
    std::unique_ptr<unsigned char[]> buffer_;
    std::size_t buffered_ = 0;
    std::uint64_t buffer_position_ = 0; ///< where the buffer's first byte goes in the file
};

/// A file of that text, whole or not at all.
void write_file(const std::filesystem::path& path, std::string_view text);

} // namespace lanecast
