#pragma once
// Faults that only `flatten` finds, at their place in the file.

#include <filesystem>
#include <string>
#include <string_view>

namespace lanecast {

/// A message of `flatten` as the loader's messages are: `file:line:column: severity: message`, the source line, a caret.
/// `message` starts with the JSON pointer of what it is about ("/objects/3: ..."); one without, or of a file that cannot be read
/// twice, gets the file alone: `file: severity: message`.
[[nodiscard]] std::string message_in_scene(const std::filesystem::path& file, std::string_view severity,
                                           std::string_view message);

} // namespace lanecast
