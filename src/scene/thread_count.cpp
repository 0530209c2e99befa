#include "scene/thread_count.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <sched.h>

namespace lanecast {
namespace {

int affinity_count() noexcept {
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
    return static_cast<int>(std::thread::hardware_concurrency()); // more than 1024 CPUs
}

/// CPUs granted by the two numbers of a group; infinity where there is no limit.
double granted(const std::string& quota, double period) {
    const double us = std::atof(quota.c_str()); // "max" and -1 mean no limit
    return us > 0 && period > 0 ? us / period : HUGE_VAL;
}

double first_number(const std::filesystem::path& file) {
    double value = 0;
    std::ifstream(file) >> value;
    return value;
}

/// The least of a group and its ancestors (control groups version 2), or of the process's only known group (version 1).
double cgroup_limit() {
    double limit = HUGE_VAL;
    const std::filesystem::path root = "/sys/fs/cgroup";
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        if (!line.starts_with("0::/")) continue;
        for (std::filesystem::path group = line.substr(4);; group = group.parent_path()) {
            std::ifstream file(root / group / "cpu.max");
            std::string quota;
            double period = 0;
            if (file >> quota >> period) limit = std::min(limit, granted(quota, period));
            if (group.empty()) break;
        }
    }
    std::string quota;
    if (std::ifstream(root / "cpu/cpu.cfs_quota_us") >> quota)
        limit = std::min(limit, granted(quota, first_number(root / "cpu/cpu.cfs_period_us")));
    return limit;
}

} // namespace

int default_thread_count() noexcept {
    int count = std::max(1, affinity_count());
    try {
        count = static_cast<int>(std::min<double>(count, std::max(1.0, std::ceil(cgroup_limit()))));
    } catch (...) { // an unreadable limit is none
    }
    return count;
}

} // namespace lanecast
