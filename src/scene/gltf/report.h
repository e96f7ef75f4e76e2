// Problems of glTF files as errors or warnings, and a limit on the memory of a scene.
#pragma once

#include "base/error.h"
#include "base/limits.h"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet {

/// One part of the file is invalid. Error's text is "FILE: PART: what".
class GltfProblem : public Error {
public:
    struct Detail {
        std::string part;
        std::string text;
        std::string_view kind;  ///< the format of `text`: the same for all problems of one kind
    };

    GltfProblem(const std::string& line, Detail d) : Error(line), detail(std::move(d)) {}

    Detail detail;
};

/// Where a part of the file is invalid, the code that finds it calls `fail`, and the code that can do without the part
/// calls what may fail through `tolerate`: an error if the report is strict, else a warning, and the rest is drawn.
class GltfReport {
public:
    explicit GltfReport(std::string file, std::function<void(const std::string&)> warn, bool strict = false)
        : file_(std::move(file)), warn_(std::move(warn)), strict_(strict) {}

    /// Throws GltfProblem "FILE: PART: what". `part` is the JSON path of the invalid part, or "" for the file itself.
    template <class... Args>
    [[noreturn]] void fail(std::string_view part, fmt::format_string<Args...> format, Args&&... args) const {
        const fmt::string_view kind = format;
        const std::string text = messageText(format, std::forward<Args>(args)...);
        throw GltfProblem(line(part, text), {std::string(part), text, {kind.data(), kind.size()}});
    }

    /// Throws an Error that nothing tolerates: the file takes too much memory or time.
    template <class... Args>
    [[noreturn]] void refuse(std::string_view part, fmt::format_string<Args...> format, Args&&... args) const {
        throw Error(line(part, messageText(format, std::forward<Args>(args)...)));
    }

    template <class... Args>
    [[noreturn]] void failUsage(std::string_view part, fmt::format_string<Args...> format, Args&&... args) const {
        throw UsageError(line(part, messageText(format, std::forward<Args>(args)...)));
    }

    /// Calls `read`, which must leave no half-read part behind if it throws. On a GltfProblem: throws it if strict,
    /// else warns "FILE: PART: consequence: what" and returns false.
    template <class Read>
    bool tolerate(std::string_view consequence, const Read& read) {
        try {
            read();
            return true;
        } catch (const GltfProblem& problem) {
            if (strict_) {
                throw;
            }
            forgive(problem.detail, consequence);
            return false;
        }
    }

    /// As tolerate, for an element that others refer to by its index in an array of the document: instead of warning,
    /// `use` throws the problem where the element is used. An element that is never used has its warning at the end.
    template <class Read>
    bool tolerateUntilUsed(std::string_view array, size_t index, const Read& read) {
        if (!invalid_.empty() && invalid_.contains({std::string(array), index})) {
            return false;  // known already
        }
        try {
            read();
            return true;
        } catch (const GltfProblem& problem) {
            if (strict_) {
                throw;
            }
            invalid_.try_emplace({std::string(array), index}, problem);
            return false;
        }
    }

    /// Throws the problem of this element, if it has one.
    void use(std::string_view array, size_t index) const {
        if (!invalid_.empty()) {
            throwIfInvalid(array, index);
        }
    }

    /// Counts the warnings of each `kind`; the first one's text is shown. The text says the consequence first.
    template <class... Args>
    void warn(const std::string& kind, std::string_view part, fmt::format_string<Args...> format, Args&&... args) {
        if (countKind(kind)) {
            warnings_.push_back({line(part, messageText(format, std::forward<Args>(args)...)), 1});
        }
    }

    /// Hands over all warnings, in the order in which their kinds occurred first.
    void printWarnings();

    /// The first problem that was tolerated, "PART: what"; empty if there was none.
    [[nodiscard]] const std::string& firstProblem() const { return firstProblem_; }

    /// Counts bytes that are about to be allocated for `part`; refuses more than memoryLimit() for one scene. A small
    /// file can ask for any amount of memory by using the same bytes many times.
    void charge(std::string_view part, uint64_t bytes);

private:
    struct Warning {
        std::string text;
        uint64_t count;
    };

    [[nodiscard]] std::string place(std::string_view part) const;
    [[nodiscard]] std::string line(std::string_view part, std::string_view what) const;
    [[nodiscard]] bool countKind(const std::string& kind);
    void forgive(const GltfProblem::Detail& problem, std::string_view consequence);
    void throwIfInvalid(std::string_view array, size_t index) const;

    std::string file_;
    std::function<void(const std::string&)> warn_;
    bool strict_;
    std::vector<Warning> warnings_;
    std::map<std::string, size_t> kinds_;  ///< index into warnings_
    std::map<std::pair<std::string, size_t>, GltfProblem> invalid_;
    std::set<std::string> told_;  ///< problems that were tolerated: an element may be invalid because of another one
    std::string firstProblem_;
    uint64_t problems_ = 0;
    uint64_t charged_ = 0;
    uint64_t memoryLimit_ = memoryLimit();
};

}  // namespace reflet
