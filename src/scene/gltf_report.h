// Error messages and warnings for glTF files, and a limit on the memory of a scene.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace reflet {

/// The text on one line: control characters become '?', and texts of more than 200 characters are truncated.
std::string oneLine(std::string_view text);

class GltfReport {
public:
    GltfReport(std::string file, std::function<void(const std::string&)> warn)
        : file_(std::move(file)), warn_(std::move(warn)) {}

    /// Throws Error "FILE: PART: what". `part` is the JSON path of the invalid part, or "" for the file itself.
    template <class... Args>
    [[noreturn]] void fail(std::string_view part, fmt::format_string<Args...> format, Args&&... args) const {
        throw Error(line(part, fmt::format(format, std::forward<Args>(args)...)));
    }

    template <class... Args>
    [[noreturn]] void failUsage(std::string_view part, fmt::format_string<Args...> format, Args&&... args) const {
        throw UsageError(line(part, fmt::format(format, std::forward<Args>(args)...)));
    }

    /// Warns once per `kind`.
    template <class... Args>
    void warn(const std::string& kind, std::string_view part, fmt::format_string<Args...> format, Args&&... args) {
        if (told_.insert(kind).second && warn_) {
            warn_(line(part, fmt::format(format, std::forward<Args>(args)...)));
        }
    }

    /// Counts bytes that are about to be allocated for `part`; fails beyond 8 GiB for one scene. A small file can ask
    /// for any amount of memory by using the same bytes many times.
    void charge(std::string_view part, uint64_t bytes);

private:
    [[nodiscard]] std::string line(std::string_view part, std::string_view what) const;

    std::string file_;
    std::function<void(const std::string&)> warn_;
    std::set<std::string> told_;
    uint64_t charged_ = 0;
};

}  // namespace reflet
