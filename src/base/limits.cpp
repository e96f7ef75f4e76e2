// Limits on what an input file may make the program take.
#include "base/limits.h"

#include "base/error.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace reflet {

namespace {

constexpr const char* variable = "REFLET_MEMORY_LIMIT";
constexpr double gib = 1024.0 * 1024.0 * 1024.0;
constexpr double standardGib = 8.0;

double limitInGib() {
    const char* text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): nothing sets the environment
    if (text == nullptr || *text == '\0') {
        return standardGib;
    }
    const std::string_view all(text);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(all.data(), all.data() + all.size(), value);
    if (error != std::errc() || rest != all.data() + all.size() || !(value >= 0.001 && value <= 1048576.0)) {
        failUsage("the environment variable {} must be a number of GiB, 0.001 to 1048576, is '{}'", variable,
                  all.substr(0, 40));
    }
    return value;
}

}  // namespace

uint64_t memoryLimit() {
    return static_cast<uint64_t>(limitInGib() * gib);
}

std::string raiseMemoryLimit(uint64_t bytes) {
    return fmt::format("set the environment variable {} to {} or more GiB to allow it", variable,
                       std::ceil(static_cast<double>(bytes) / gib));
}

std::string imageExcess(uint64_t width, uint64_t height, uint64_t bytesPerPixel) {
    constexpr uint64_t shareOfOne = 4;
    constexpr uint64_t mostPixels = uint64_t{1} << 48U;  // products below stay in 64 bits
    const uint64_t limit = memoryLimit();
    const bool huge = height != 0 && width > mostPixels / height;
    const uint64_t bytes = huge ? UINT64_MAX / shareOfOne : width * height * bytesPerPixel;
    if (!huge && bytes <= limit / shareOfOne) {
        return "";
    }
    return fmt::format("takes {:.1f} GiB to decode {} x {} pixels, a single image may take {:.3g} GiB: {}",
                       static_cast<double>(bytes) / gib, width, height,
                       static_cast<double>(limit) / gib / double{shareOfOne}, raiseMemoryLimit(shareOfOne * bytes));
}

}  // namespace reflet
