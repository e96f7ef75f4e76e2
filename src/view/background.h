// Runs work in the background while the window stays responsive.
#pragma once

#include "view/window.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

namespace reflet {

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
            return work(cancelled_);
        });
    }

    /// The result, once it is there; empty afterwards. Rethrows what the work threw.
    std::optional<T> take() {
        if (!busy() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return std::nullopt;
        }
        return future_.get();
    }

    /// Asks the work to end; that may take a while.
    void cancel() { cancelled_ = true; }
    [[nodiscard]] bool cancelled() const { return cancelled_; }

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
