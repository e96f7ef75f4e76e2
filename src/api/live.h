// Which handles exist: calls with one that was destroyed are refused.
#pragma once

#include "api/calls.h"

#include <mutex>
#include <unordered_set>

namespace reflet::api {

/// The handles of one type, in this process.
template <class T>
class Live {
public:
    static void add(const T* handle) {
        const std::scoped_lock lock(mutex());
        all().insert(handle);
    }
    /// Whether it was there.
    static bool remove(const T* handle) {
        const std::scoped_lock lock(mutex());
        return all().erase(handle) != 0;
    }
    static bool contains(const T* handle) {
        const std::scoped_lock lock(mutex());
        return all().contains(handle);
    }

private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    static std::unordered_set<const T*>& all() {
        static std::unordered_set<const T*> set;
        return set;
    }
};

/// Throws Failure for NULL and for a handle that does not exist. name: of the argument.
template <class T>
void checkHandle(const T* handle, const char* name) {
    if (handle == nullptr) {
        failArgument("{}: is NULL", name);
    }
    if (!Live<T>::contains(handle)) {
        failArgument("{}: was not made by this library, or has been destroyed", name);
    }
}

}  // namespace reflet::api
