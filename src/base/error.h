// The three kinds of failure and how each is told. A bug: REFLET_CHECK, never compiled out. The world (a file,
// a device, an argument): an exception whose message says what, where and what to do. Absence: std::optional.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <stdexcept>
#include <string>

namespace reflet {

/// Something outside the program failed. The message is one line without a full stop. Exit status 1.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The program was asked for something that it cannot be asked for. Exit status 2.
class UsageError : public Error {
public:
    using Error::Error;
};

/// Throws Error with a formatted message: fail("{}: cannot be read", path).
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fmt::format(format, std::forward<Args>(args)...));
}

/// Throws UsageError with a formatted message.
template <class... Args>
[[noreturn]] void failUsage(fmt::format_string<Args...> format, Args&&... args) {
    throw UsageError(fmt::format(format, std::forward<Args>(args)...));
}

/// A broken invariant of our own. Throws std::logic_error, in every build.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace reflet

/// REFLET_CHECK(a == b, "{} {}", a, b): the invariant, and the values that broke it.
#define REFLET_CHECK(condition, ...)                                                         \
    do {                                                                                     \
        if (!(condition)) [[unlikely]]                                                       \
            ::reflet::checkFailed(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)); \
    } while (false)
