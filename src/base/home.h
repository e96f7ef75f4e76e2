// The user's home folder.
#pragma once

#include <filesystem>
#include <optional>

namespace reflet {

/// $HOME, or without it the folder in the user database; none if neither is an absolute path.
std::optional<std::filesystem::path> homeFolder();

}  // namespace reflet
