#pragma once
// Public scenes and meshes that are not part of the repository: from LANECAST_SHARED, or `shared` beside the source directory.

#include <cstdlib>
#include <filesystem>
#include <optional>

#include <doctest/doctest.h>

/// Empty, with a message, where this machine has no such directory; the test then passes without having tested.
inline std::optional<std::filesystem::path> shared_directory(const char* name) {
    const char* const set = std::getenv("LANECAST_SHARED");
    const std::filesystem::path root =
        set != nullptr ? std::filesystem::path(set) : std::filesystem::path(LANECAST_SOURCE_DIR) / "../shared";
    if (std::filesystem::is_directory(root / name)) return root / name;
    MESSAGE("skipped: no directory " << (root / name).string());
    return std::nullopt;
}
