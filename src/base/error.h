// The three kinds of failure. Bugs: REFLET_CHECK, never compiled out. External failures (a file, a device, an
// argument): an exception whose message says what, where and what to do. Absence: std::optional.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace reflet {

/// Something outside the program failed. The message is one line without a full stop. Exit status 1.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Wrong use: an invalid command line. Exit status 2.
class UsageError : public Error {
public:
    using Error::Error;
};

/// fmt::vformat for messages, whose arguments may come from outside: texts are shown by visibleText, and those that
/// stand in quotes, '{}', by oneLine, as are words of over 255 bytes.
std::string formatMessage(fmt::string_view format, fmt::format_args args);

/// The same with arguments as of fmt::format, checked when compiled.
template <class... Args>
std::string messageText(fmt::format_string<Args...> format, Args&&... args) {
    return formatMessage(format, fmt::make_format_args(args...));
}

/// Throws Error with a formatted message: fail("{}: cannot be read", path).
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(formatMessage(format, fmt::make_format_args(args...)));
}

/// Throws UsageError with a formatted message.
template <class... Args>
[[noreturn]] void failUsage(fmt::format_string<Args...> format, Args&&... args) {
    throw UsageError(formatMessage(format, fmt::make_format_args(args...)));
}

/// Reports a failed invariant (a bug). Throws std::logic_error, in every build.
[[noreturn]] void checkFailed(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace reflet

/// REFLET_CHECK(a == b, "{} {}", a, b): an invariant, and the values to report if it fails.
#define REFLET_CHECK(condition, ...)                                                         \
    do {                                                                                     \
        if (!(condition)) [[unlikely]]                                                       \
            ::reflet::checkFailed(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)); \
    } while (false)
