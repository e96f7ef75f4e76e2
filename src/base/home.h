// The user's home folder.
#pragma once

#include <filesystem>
#include <optional>

namespace reflet {

/// Reflet's cache folder, whose files can be regenerated: $XDG_CACHE_HOME/reflet, or ~/.cache/reflet; none without a
/// home. Never the shared temporary folder, where other users could plant files.
std::optional<std::filesystem::path> cacheFolder();

/// $HOME, or without it the folder in the user database; none if neither is an absolute path.
std::optional<std::filesystem::path> homeFolder();

}  // namespace reflet
