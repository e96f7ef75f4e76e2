// Runs work in the background while the window stays responsive.
#pragma once

#include "view/clock.h"
#include "view/window.h"

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

namespace reflet {

/// Lowers the priority of the calling thread, and of threads that it starts from now on (such as those of a CPU's
/// Vulkan driver), so that the window stays responsive. Linux only: elsewhere niceness applies to the whole process, so
/// this does nothing.
inline void stepBack() {
#ifdef __linux__
    constexpr int niceness = 10;
    ::setpriority(PRIO_PROCESS, 0, niceness);
#endif
}

/// Runs one task at a time, on a separate thread.
template <class T>
class BackgroundTask {
public:
    BackgroundTask() = default;
    ~BackgroundTask() { stop(); }
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    [[nodiscard]] bool busy() const { return future_.valid(); }

    /// Must not be called while busy. The work should end early once `cancelled` is set.
    void start(std::function<T(const std::atomic<bool>& cancelled)> work) {
        cancelled_ = false;
        future_ = std::async(std::launch::async, [this, work = std::move(work)] {
            struct Waker {
                ~Waker() { Window::wake(); }
            } const waker;  // also wakes the window after an exception
            stepBack();
            return work(cancelled_);
        });
    }

    /// The result, once available; empty afterwards. Rethrows exceptions of the work.
    std::optional<T> take() {
        if (!busy() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return std::nullopt;
        }
        return future_.get();
    }

    /// Cancels the work, waits for it, and drops its result or exception.
    void discard() {
        stop();
        if (busy()) {
            try {
                future_.get();
            } catch (const std::exception&) {  // no longer of interest
            }
        }
    }

    /// Requests that the work end; that may take a while.
    void cancel() { cancelled_ = true; }
    [[nodiscard]] bool cancelled() const { return cancelled_; }

    /// Waits for the work to end, until `end` at most. Returns whether it has ended.
    [[nodiscard]] bool endsBy(Clock::time_point end) const {
        return !busy() || future_.wait_until(end) == std::future_status::ready;
    }

    void stop() {
        cancel();
        if (busy()) {
            future_.wait();
        }
    }

private:
    std::atomic<bool> cancelled_ = false;
    std::future<T> future_;
};

}  // namespace reflet
