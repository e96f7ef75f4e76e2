// Problems of glTF files as errors or warnings, and a limit on the memory of a scene.
#include "scene/gltf/report.h"

#include "base/visible_text.h"

#include <algorithm>

namespace reflet {

namespace {
constexpr uint64_t maxProblems = 100000;  // each takes microseconds
constexpr size_t maxWarnings = 19;        // lines for one file, and one that counts the rest
constexpr size_t longestPart = 200;
constexpr size_t longestText = 400;
}  // namespace

std::string GltfReport::place(std::string_view part) const {
    return visibleText(file_) + ": " + (part.empty() ? "" : oneLine(part, longestPart) + ": ");
}

std::string GltfReport::line(std::string_view part, std::string_view what) const {
    return place(part) + oneLine(what, longestText);
}

bool GltfReport::countKind(const std::string& kind) {
    const auto [found, isNew] = kinds_.try_emplace(kind, warnings_.size());
    if (!isNew) {
        ++warnings_[found->second].count;
    }
    return isNew;
}

void GltfReport::forgive(const GltfProblem::Detail& problem, std::string_view consequence) {
    if (++problems_ > maxProblems) {
        refuse("", "has more than {} problems", maxProblems);
    }
    told_.insert(line(problem.part, problem.text));
    if (firstProblem_.empty()) {
        firstProblem_ = problem.part.empty() ? problem.text : problem.part + ": " + problem.text;
    }
    if (countKind(fmt::format("{}: {}", consequence, problem.kind))) {
        warnings_.push_back(
            {fmt::format("{}{}: {}", place(problem.part), consequence, oneLine(problem.text, longestText)), 1});
    }
}

void GltfReport::throwIfInvalid(std::string_view array, size_t index) const {
    const auto found = invalid_.find({std::string(array), index});
    if (found != invalid_.end()) {
        throw GltfProblem(found->second);
    }
}

void GltfReport::printWarnings() {
    for (const auto& [element, problem] : invalid_) {
        if (!told_.contains(problem.what())) {
            forgive(problem.detail, "nothing is missing, because nothing uses it");
        }
    }
    invalid_.clear();
    for (size_t i = 0; warn_ && i < std::min(warnings_.size(), maxWarnings); ++i) {
        const Warning& warning = warnings_[i];
        const std::string more = warning.count > 1 ? fmt::format(" (and {} more)", warning.count - 1) : "";
        warn_(warning.text + more);
    }
    if (warn_ && warnings_.size() > maxWarnings) {
        warn_(fmt::format("{}{} more warnings of other kinds", place(""), warnings_.size() - maxWarnings));
    }
    warnings_.clear();
    kinds_.clear();
}

void GltfReport::charge(std::string_view part, uint64_t bytes) {
    const uint64_t limit = memoryLimit_;
    if (bytes > limit - charged_) {
        refuse(part, "takes the scene past the limit of {:.3g} GiB of memory: {}", static_cast<double>(limit) / 0x1p30,
               raiseMemoryLimit(std::max(bytes, charged_ + bytes)));
    }
    charged_ += bytes;
}

}  // namespace reflet
