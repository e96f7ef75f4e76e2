// Registry of existing handles: calls with a destroyed handle are refused.
#pragma once

#include "api/calls.h"

#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>

namespace reflet::api {

/// The handles of one type, in this process. Calls hold a reference, so that another thread may destroy the object
/// meanwhile.
template <class T>
class Live {
public:
    static void add(std::shared_ptr<T> object) {
        const std::scoped_lock lock(mutex());
        const T* const handle = object.get();
        all().emplace(handle, std::move(object));
    }
    /// Removes and returns the object; later calls do not find it. None if it was not registered.
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
    // Never destroyed: at the end of the process, objects that a host has left may belong to a device that no longer
    // exists.
    static std::unordered_map<const T*, std::shared_ptr<T>>& all() {
        static auto* const map = new std::unordered_map<const T*, std::shared_ptr<T>>;
        return *map;
    }
};

/// The object behind a handle, kept alive while the caller holds it. Throws Failure for NULL and for a handle that does
/// not exist. name: of the argument.
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
