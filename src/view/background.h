// Work that goes on while the window stays alive.
#pragma once

#include "view/window.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

namespace reflet {

/// One piece of work at a time, on a thread of its own.
template <class T>
class Background {
public:
    Background() = default;
    ~Background() { stop(); }
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    [[nodiscard]] bool busy() const { return future_.valid(); }

    /// Not while it is busy. The work is asked to end early when the flag goes up.
    void start(std::function<T(const std::atomic<bool>& cancelled)> work) {
        cancelled_ = false;
        future_ = std::async(std::launch::async, [this, work = std::move(work)] {
            struct Waker {
                ~Waker() { Window::wake(); }
            } const waker;  // also after what is thrown
            return work(cancelled_);
        });
    }

    /// What it has come to, once. Throws what the work has thrown.
    std::optional<T> take() {
        if (!busy() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return std::nullopt;
        }
        return future_.get();
    }

    /// Nobody wants it any more; it may take a while to end.
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
