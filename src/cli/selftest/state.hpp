#pragma once
// A run's progress as a small text file, so that two hours may be had in pieces.

#include "cli/selftest/progress.hpp"

#include <filesystem>

namespace lanecast::selftest {

/// `run` says what was asked for: the version, the size, the kernels. Appears whole or not at all. Throws Error (output).
void write_state(const std::filesystem::path& file, const std::string& run, const std::vector<Progress>& all);

/// Fills in what the file says of the same cases; nothing where there is no such file. Throws Error (usage) where it is of
/// another run, or is none.
void read_state(const std::filesystem::path& file, const std::string& run, std::vector<Progress>& all);

} // namespace lanecast::selftest
