#pragma once

namespace lanecast {

/// CPUs this process may use: those of its affinity mask, but no more than the CPU time its control groups grant, rounded up.
[[nodiscard]] int default_thread_count() noexcept;

} // namespace lanecast
