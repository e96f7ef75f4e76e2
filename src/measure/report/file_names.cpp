// Makes file names.
#include "measure/report/file_names.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

std::string fileNameOf(std::string_view text) {
    constexpr size_t longest = 60;
    constexpr std::string_view upper = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyz0123456789_-";
    std::string name;
    for (const char c : text) {
        if (const size_t letter = upper.find(c); letter != std::string_view::npos) {
            name += plain[letter];
        } else if (plain.find(c) != std::string_view::npos) {
            name += c;
        } else if (!name.empty() && name.back() != '-') {
            name += '-';
        }
    }
    name.resize(std::min(name.size(), longest));
    while (name.ends_with('-')) {
        name.pop_back();
    }
    return name.empty() ? "unnamed" : name;
}

std::string FileNames::take(const std::string& wanted) {
    std::string name = wanted;
    for (unsigned number = 2; !taken_.insert(name).second; ++number) {
        name = fmt::format("{}-{}", wanted, number);
    }
    return name;
}

}  // namespace reflet
