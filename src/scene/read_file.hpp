#pragma once
// A whole file in one read. Not mapped: a mapped file that shrinks under us is a bus error.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lanecast {

struct FileBytes {
    std::unique_ptr<char[]> data;
    std::size_t size = 0;
    std::string fault; ///< why it could not be read: "No such file or directory"; else empty

    [[nodiscard]] std::string_view view() const { return {data.get(), size}; }
};

/// Anything but a regular file is a fault, and never waited for.
[[nodiscard]] FileBytes read_file(const std::filesystem::path& file);

/// A pipe, too, to its end: of what a program writes it is waited for however long it takes; for a program, five seconds.
[[nodiscard]] FileBytes read_file_or_pipe(const std::filesystem::path& file);

} // namespace lanecast
