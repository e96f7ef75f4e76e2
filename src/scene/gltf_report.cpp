// Error messages and warnings for glTF files, and a limit on the memory of a scene.
#include "scene/gltf_report.h"

#include <algorithm>
#include <cctype>

namespace reflet {

namespace {
constexpr size_t maxLineLength = 200;
constexpr uint64_t maxSceneBytes = 8ULL << 30U;
}  // namespace

std::string oneLine(std::string_view text) {
    std::string result(text.substr(0, maxLineLength));
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
    return text.size() > maxLineLength ? result + "..." : result;
}

std::string GltfReport::line(std::string_view part, std::string_view what) const {
    std::string result = oneLine(file_) + ": ";
    if (!part.empty()) {
        result += oneLine(part) + ": ";
    }
    return result + oneLine(what);
}

void GltfReport::charge(std::string_view part, uint64_t bytes) {
    if (bytes > maxSceneBytes - charged_) {
        fail(part, "takes the scene past the limit of {} GiB of memory", maxSceneBytes >> 30U);
    }
    charged_ += bytes;
}

}  // namespace reflet
