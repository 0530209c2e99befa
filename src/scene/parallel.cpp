#include "scene/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace lanecast {
namespace {

/// One loop. Every thread that takes part calls work().
class Loop {
public:
    Loop(std::size_t count, const std::function<void(std::size_t)>& body) : count_(count), body_(body) {}

    void work() noexcept {
        try {
            for (std::size_t i = next_.fetch_add(1); i < count_; i = next_.fetch_add(1)) body_(i);
        } catch (...) {
            next_ = count_; // the others finish what they have
            const std::lock_guard lock(mutex_);
            if (!first_error_) first_error_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (first_error_) std::rethrow_exception(first_error_);
    }

private:
    std::size_t count_;
    const std::function<void(std::size_t)>& body_;
    std::atomic<std::size_t> next_{0};
    std::exception_ptr first_error_;
    std::mutex mutex_;
};

} // namespace

class Team::Helpers {
public:
    explicit Helpers(std::size_t count) {
        threads_.reserve(count);
        try {
            for (std::size_t i = 0; i < count; ++i) threads_.emplace_back([this] { serve(); });
        } catch (const std::system_error&) { // no more threads are to be had: those that there are do the work
        }
    }
    ~Helpers() {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
        called_.notify_all();
    } // the threads join first: they are the last member

    void share(Loop& loop, std::size_t helpers) {
        {
            const std::lock_guard lock(mutex_);
            loop_ = &loop;
            places_ = helpers;
        }
        helpers == 1 ? called_.notify_one() : called_.notify_all();
        loop.work();
        std::unique_lock lock(mutex_);
        places_ = 0;
        finished_.wait(lock, [this] { return at_work_ == 0; });
    }

private:
    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            called_.wait(lock, [this] { return places_ > 0 || is_over_; });
            if (is_over_) return;
            --places_;
            ++at_work_;
            lock.unlock();
            loop_->work();
            lock.lock();
            if (--at_work_ == 0) finished_.notify_one();
        }
    }

    std::mutex mutex_;
    std::condition_variable called_, finished_;
    Loop* loop_ = nullptr;
    std::size_t places_ = 0, at_work_ = 0; ///< helpers that may still come, and that have
    bool is_over_ = false;
    std::vector<std::jthread> threads_;
};

namespace {
thread_local Team* team_of_this_thread = nullptr; ///< null while it shares a loop
}

Team::Team(int threads) {
    if (threads <= 1 || team_of_this_thread != nullptr) return;
    helpers_ = std::make_unique<Helpers>(static_cast<std::size_t>(threads) - 1);
    team_of_this_thread = this;
}

Team::~Team() {
    if (helpers_ != nullptr) team_of_this_thread = nullptr;
}

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body) {
    const std::size_t workers = std::min(static_cast<std::size_t>(std::max(threads, 1)), count);
    if (workers <= 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    Loop loop(count, body);
    if (Team* const team = team_of_this_thread; team != nullptr) {
        team_of_this_thread = nullptr;
        team->helpers_->share(loop, workers - 1);
        team_of_this_thread = team;
    } else {
        std::vector<std::jthread> others;
        others.reserve(workers - 1);
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back([&] { loop.work(); });
        loop.work();
    }
    loop.rethrow();
}

} // namespace lanecast
