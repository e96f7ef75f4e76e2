// File names of a sequence.
#include "job/sequence_names.h"

#include "base/ascii.h"
#include "base/error.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

bool FrameNames::isPattern(const std::string& output) {
    return fs::path(output).filename().string().find('#') != std::string::npos;
}

FrameNames::FrameNames(const std::string& pattern) : pattern_(pattern), folder_(fs::path(pattern).parent_path()) {
    const std::string name = fs::path(pattern).filename().string();
    const size_t first = name.find('#');
    REFLET_CHECK(first != std::string::npos, "{}", pattern);
    const size_t end = std::min(name.find_first_not_of('#', first), name.size());
    if (name.find('#', end) != std::string::npos) {
        failUsage("{}: the name has two runs of #; use one for the frame number", pattern);
    }
    before_ = name.substr(0, first);
    after_ = name.substr(end);
    digits_ = end - first;
}

fs::path FrameNames::file(uint32_t number) const {
    return folder_ / fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

bool FrameNames::matches(std::string_view name) const {
    if (!name.starts_with(before_) || !name.ends_with(after_) ||
        name.size() < before_.size() + digits_ + after_.size()) {
        return false;
    }
    name.remove_prefix(before_.size());
    name.remove_suffix(after_.size());
    return std::ranges::all_of(name, isAsciiDigit);
}

std::vector<fs::path> FrameNames::existing() const {
    std::vector<fs::path> files;
    std::error_code error;
    const fs::directory_iterator entries(folder_.empty() ? fs::path(".") : folder_, error);
    if (error) {
        fail("{}: the folder cannot be read: {}", pattern_, error.message());
    }
    for (const auto& entry : entries) {
        if (std::error_code ignored; !entry.is_directory(ignored) && matches(entry.path().filename().string())) {
            files.push_back(folder_ / entry.path().filename());
        }
    }
    return files;
}

std::vector<uint32_t> FrameNames::numbers() const {
    std::vector<uint32_t> all;
    for (const fs::path& path : existing()) {
        const std::string name = path.filename().string();
        const char* end = name.data() + name.size() - after_.size();
        uint32_t number = 0;
        const auto [rest, error] = std::from_chars(name.data() + before_.size(), end, number);
        if (error == std::errc() && rest == end && file(number) == path) {  // not another number of digits
            all.push_back(number);
        }
    }
    std::ranges::sort(all);
    return all;
}

}  // namespace reflet
