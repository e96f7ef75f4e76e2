// Makes file names from the names of scenes and variants.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace reflet {

/// ASCII lower-case letters, digits, '-' and '_'; every run of other characters becomes one '-'. Never empty, at most
/// 60 characters.
std::string fileNameOf(std::string_view text);

/// Hands out each name once: "cubes", then "cubes-2".
class FileNames {
public:
    std::string take(const std::string& wanted);

private:
    std::set<std::string> taken_;
};

}  // namespace reflet
