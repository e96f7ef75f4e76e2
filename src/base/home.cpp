// The user's home folder.
#include "base/home.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace reflet {

std::optional<std::filesystem::path> homeFolder() {
    const char* home = std::getenv("HOME");  // NOLINT(concurrency-mt-unsafe): nothing sets the environment
    if (home != nullptr && *home == '/') {
        return home;
    }
    std::vector<char> texts(16384);
    passwd entry{};
    passwd* found = nullptr;
    if (::getpwuid_r(::getuid(), &entry, texts.data(), texts.size(), &found) == 0 && found != nullptr &&
        found->pw_dir != nullptr && *found->pw_dir == '/') {
        return found->pw_dir;
    }
    return std::nullopt;
}

std::optional<std::filesystem::path> cacheFolder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");  // NOLINT(concurrency-mt-unsafe): nothing sets the environment
    if (cache != nullptr && *cache != '\0') {
        return std::filesystem::path(cache) / "reflet";
    }
    const auto home = homeFolder();
    return home ? std::optional(*home / ".cache" / "reflet") : std::nullopt;
}

}  // namespace reflet
