// Which handles exist: calls with one that was destroyed are refused.
#pragma once

#include "api/calls.h"

#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>

namespace reflet::api {

/// The handles of one type, in this process. Calls hold what they work on, so that another thread may destroy it.
template <class T>
class Live {
public:
    static void add(std::shared_ptr<T> object) {
        const std::scoped_lock lock(mutex());
        const T* const handle = object.get();
        all().emplace(handle, std::move(object));
    }
    /// Nobody else gets it any more. None if it was not there.
    static std::shared_ptr<T> take(const T* handle) {
        const std::scoped_lock lock(mutex());
        const auto found = all().find(handle);
        if (found == all().end()) {
            return nullptr;
        }
        std::shared_ptr<T> object = std::move(found->second);
        all().erase(found);
        return object;
    }
    /// None if it was not there.
    static std::shared_ptr<T> get(const T* handle) {
        const std::scoped_lock lock(mutex());
        const auto found = all().find(handle);
        return found != all().end() ? found->second : nullptr;
    }

private:
    static std::mutex& mutex() {
        static auto* const one = new std::mutex;
        return *one;
    }
    // Never destroyed: at the end of the process, what a host has left may be of a device that is gone.
    static std::unordered_map<const T*, std::shared_ptr<T>>& all() {
        static auto* const map = new std::unordered_map<const T*, std::shared_ptr<T>>;
        return *map;
    }
};

/// What a handle stands for, while the caller holds it. Throws Failure for NULL and for a handle that does not exist.
/// name: of the argument.
template <class T>
[[nodiscard]] std::shared_ptr<T> held(const T* handle, const char* name) {
    if (handle == nullptr) {
        failArgument("{}: is NULL", name);
    }
    std::shared_ptr<T> object = Live<T>::get(handle);
    if (!object) {
        failArgument("{}: was not made by this library, or has been destroyed", name);
    }
    return object;
}

/// Waits until calls that have it have ended. They must not wait for this thread.
template <class T>
void waitForCalls(const std::shared_ptr<T>& taken) {
    while (taken.use_count() > 1) {
        std::this_thread::yield();
    }
}

}  // namespace reflet::api
