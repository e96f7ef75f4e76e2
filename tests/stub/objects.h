// The objects of the driver without a device.
#pragma once

#include "stub/driver.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace reflet::stub {

/// A frame's commands. Never freed, so that objects may always ask.
struct Commands {
    std::atomic<uint64_t> begun = 0;     ///< times that it was begun
    std::atomic<uint64_t> finished = 0;  ///< what `begun` was when the device had executed it
};

/// With AddressSanitizer, use after destruction is its report; elsewhere the mark shows most of it.
struct Object {
    static constexpr uint32_t mark = 0x5EF1E700;

    explicit Object(Kind of) : kind(of) {}

    uint32_t alive = mark;
    Kind kind;
    const Commands* user = nullptr;  ///< that uses it last
    uint64_t use = 0;                ///< its Commands::begun
};

struct Image : Object {
    explicit Image(const VkImageCreateInfo& info);
    uint64_t bytes = 0;
    uint32_t mips = 1;
    uint32_t layers = 1;
    bool bound = false;
};

struct ImageView : Object {
    ImageView() : Object(Kind::imageView) {}
    Image* image = nullptr;
};

struct Buffer : Object {
    Buffer() : Object(Kind::buffer) {}
    uint64_t bytes = 0;
    bool bound = false;
};

struct Memory : Object {
    Memory() : Object(Kind::memory) {}
    uint64_t bytes = 0;
    uint32_t type = 0;
    void* mapped = nullptr;
};

struct Pool;

struct Set : Object {
    Set() : Object(Kind::set) {}
    Pool* pool = nullptr;
    std::vector<std::pair<uint32_t, Object*>> bound;  ///< by binding
};

struct Pool : Object {
    Pool() : Object(Kind::pool) {}
    uint32_t most = 0;
    std::vector<Set*> sets;
};

[[noreturn]] inline void misuse(const char* what, const char* call) {
    std::fprintf(stderr, "misuse of the Vulkan driver: %s (%s)\n", what, call);
    std::abort();
}

template <class Handle>
uint64_t bitsOf(Handle handle) {
    return reinterpret_cast<uint64_t>(handle);
}

/// Whether the driver made it.
template <class Handle>
bool isOwn(Handle handle) {
    return bitsOf(handle) != 0 && (bitsOf(handle) & 1U) == 0;
}

/// Of a handle that the driver made; the call is misuse otherwise.
template <class T, class Handle>
T& known(Handle handle, Kind kind, const char* call) {
    if (!isOwn(handle)) {
        misuse("a handle that is NULL or not of the driver", call);
    }
    T& object = *reinterpret_cast<T*>(handle);
    if (object.alive != Object::mark) {
        misuse("an object that has been destroyed", call);
    }
    if (object.kind != kind) {
        misuse("an object of another kind", call);
    }
    return object;
}

inline void checkUnused(const Object& object, const char* call) {
    if (object.user != nullptr && object.user->finished < object.use) {
        misuse("an object that unfinished commands use", call);
    }
}

/// For the counts, and the calls that shall fail. Returns what the call returns.
VkResult beginMaking();
void noteMade(Kind kind);
void noteGone(Kind kind);

template <class T, class Handle, class... Args>
VkResult make(Handle* handle, Args&&... args) {
    if (const VkResult result = beginMaking(); result != VK_SUCCESS) {
        *handle = reinterpret_cast<Handle>(uint64_t{0xDEADDEADDEAD0000});  // undefined by the specification
        return result;
    }
    T* const object = new T(std::forward<Args>(args)...);
    noteMade(object->kind);
    *handle = reinterpret_cast<Handle>(object);
    return VK_SUCCESS;
}

template <class T>
void drop(T& object) {
    noteGone(object.kind);
    object.alive = 0;
    delete &object;
}

/// A destroy function of Vulkan.
template <class T, Kind K, class Pfn>
struct Destroying;
template <class T, Kind K, class Handle>
struct Destroying<T, K, void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*)> {
    static VKAPI_ATTR void VKAPI_CALL call(VkDevice /*device*/, Handle handle, const VkAllocationCallbacks* /*host*/) {
        if (handle != VK_NULL_HANDLE) {
            auto& object = known<T>(handle, K, "vkDestroy");
            checkUnused(object, "vkDestroy");
            drop(object);
        }
    }
};

}  // namespace reflet::stub
