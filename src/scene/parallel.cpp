#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lanecast {

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body) {
    const std::size_t workers = std::min(static_cast<std::size_t>(std::max(threads, 1)), count);
    if (workers <= 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::atomic<std::size_t> next{0};
    std::exception_ptr first_error;
    std::mutex error_mutex;
    const auto work = [&] {
        try {
            for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) body(i);
        } catch (...) {
            next = count; // the others finish what they have
            const std::lock_guard lock(error_mutex);
            if (!first_error) first_error = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        others.reserve(workers - 1);
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back(work);
        work();
    }
    if (first_error) std::rethrow_exception(first_error);
}

} // namespace lanecast
