// Common code of all C API functions: argument checks, exceptions to result codes, error texts.
#pragma once

#include "base/error.h"

#include "reflet/reflet.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <string>

namespace reflet::api {

/// A failure with the result that the host gets.
class Failure : public Error {
public:
    Failure(RefletResult result, const std::string& text) : Error(text), result_(result) {}
    [[nodiscard]] RefletResult result() const { return result_; }

private:
    RefletResult result_;
};

template <class... Args>
[[noreturn]] void failWith(RefletResult result, fmt::format_string<Args...> format, Args&&... args) {
    throw Failure(result, formatMessage(format, fmt::make_format_args(args...)));
}

template <class... Args>
[[noreturn]] void failArgument(fmt::format_string<Args...> format, Args&&... args) {
    throw Failure(REFLET_ERROR_INVALID_ARGUMENT, formatMessage(format, fmt::make_format_args(args...)));
}

/// Error text of this thread's last failed call.
std::string& lastError();

/// Notes the exception that is being handled, and returns its result. To be called in a catch block.
RefletResult handleException();

/// Runs the body of a function of the API.
template <class F>
RefletResult guarded(const F& body) {
    try {
        body();
        return REFLET_SUCCESS;
    } catch (...) {
        return handleException();
    }
}

/// Copies a host's struct to this library's version of it: fields that an older host lacks are zero. least: the
/// struct's size in version 0.2, the first with this ABI, if it has grown since. Throws Failure for NULL and for a size
/// that cannot be.
template <class T>
T adopted(const T* given, const char* name, size_t least = sizeof(T)) {
    if (given == nullptr) {
        failArgument("{}: is NULL", name);
    }
    T result{};
    // The size of every version of a struct is a multiple of its alignment; another size would copy half a pointer.
    if (given->structSize < least || given->structSize % alignof(T) != 0) {
        failArgument("{}.structSize: is {}; set it to sizeof the struct, here {}", name, given->structSize, sizeof(T));
    }
    if (given->structSize > sizeof(T)) {
        failWith(REFLET_ERROR_INCOMPATIBLE_VERSION,
                 "{}.structSize: is {}, and this library knows {} bytes: the header is newer than the library", name,
                 given->structSize, sizeof(T));
    }
    std::memcpy(&result, given, given->structSize);
    return result;
}

/// Element i of an array of structs, whose stride is the structSize of the first (perhaps of an older header).
template <class T>
const T* elementOf(const T* first, size_t i) {
    return i == 0 ? first
                  : reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(first) + i * first->structSize);
}

/// Throws Failure unless it is 0 or 1.
inline void checkBoolean(uint32_t value, const char* name) {
    if (value > 1) {
        failArgument("{}: is {}; must be 0 or 1", name, value);
    }
}

/// Throws Failure unless it is a value of the enum.
inline void checkDepthKind(RefletDepthKind kind, const char* name) {
    if (kind != REFLET_DEPTH_REVERSED && kind != REFLET_DEPTH_STANDARD) {
        failArgument("{}: is {}; known values are 0 and 1", name, static_cast<int>(kind));
    }
}

}  // namespace reflet::api
