#pragma once
// Building trees, in turn with Embree: triangles per second, memory, quality.

#include "cli/bench/bench_mesh.hpp"

#include <chrono>
#include <ctime>
#include <string>

namespace lanecast::bench {

struct BuildsRequest {
    int threads = 2;
    int repetitions = 7;
    bool high = false; ///< with spatial splits, on both sides
    bool with_peer = true;
};

/// Ours: from a mesh read to arrays that rays can be traced against. Embree's: its commit, buffers filled beforehand. A table of
/// one line, with `header` the names of the columns before it. Throws Error.
[[nodiscard]] std::string measure_builds(const BenchMesh& mesh, const std::string& isa, const BuildsRequest& request,
                                         bool header);

/// Of one build: seconds, and bytes kept.
struct BuildTime {
    double wall = 0, processor = 0, bytes = 0;
};

/// False where Embree is not there, or not at this instruction set.
[[nodiscard]] bool time_embree_build(const BenchMesh& mesh, const std::string& isa, bool high, int threads, BuildTime& time);

class Stopwatch {
public:
    /// Into `time`: since construction.
    void stop(BuildTime& time) const {
        time.processor = processor_time() - processor_;
        time.wall = std::chrono::duration<double>(Clock::now() - wall_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    [[nodiscard]] static double processor_time() { // of all threads
        std::timespec now{};
        ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
    Clock::time_point wall_ = Clock::now();
    double processor_ = processor_time();
};

} // namespace lanecast::bench
