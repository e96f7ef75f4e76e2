// Environment images: lookup by direction, and reading from files.
#include "scene/environment.h"

#include "base/ascii.h"
#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace reflet {
namespace {

/// The texel that contains a coordinate in 0..1; 1 is in the last one.
uint32_t texelOf(float coordinate, uint32_t count) {
    return std::min(static_cast<uint32_t>(coordinate * static_cast<float>(count)), count - 1);
}

/// R, G and B of the unnamed layer, in this order.
FloatImage readExrColors(const std::filesystem::path& path) {
    const std::vector<ImageLayer> layers = readExr(path);
    const bool hasUnnamed = !layers.empty() && layers.front().name.empty();
    const FloatImage all = hasUnnamed ? layers.front().image : FloatImage{};
    FloatImage colors{all.width, all.height, {"R", "G", "B"}, {}};
    std::vector<size_t> sources;
    for (const std::string& channel : colors.channels) {
        const auto found = std::ranges::find(all.channels, channel);
        if (found == all.channels.end()) {
            fail("{}: cannot be used as an environment: it has no channel '{}' in its unnamed layer", path.string(),
                 channel);
        }
        sources.push_back(static_cast<size_t>(found - all.channels.begin()));
    }
    colors.data.reserve(size_t{3} * all.width * all.height);
    for (size_t texel = 0; texel < all.data.size(); texel += all.channels.size()) {
        for (const size_t source : sources) {
            colors.data.push_back(all.data[texel + source]);
        }
    }
    return colors;
}

void checkValues(const std::filesystem::path& path, const FloatImage& image) {
    const auto wrong = std::ranges::find_if(image.data, [](float value) {
        return !(value >= 0.0F && value <= static_cast<float>(largestRadiance));  // NaN is wrong too
    });
    if (wrong != image.data.end()) {
        const auto index = static_cast<size_t>(wrong - image.data.begin());
        fail(
            "{}: cannot be used as an environment: channel {} at column {}, row {} (from 0, top left) is {:g}, must be "
            "0 to "
            "{:g}",
            path.string(), image.channels[index % 3], index / 3 % image.width, index / 3 / image.width, *wrong,
            largestRadiance);
    }
}

}  // namespace

vec2 environmentUv(const vec3& direction, float rotation) {
    const float u = 0.5F + (std::atan2(direction.x, -direction.z) + rotation) / (2.0F * pi);
    const float wrapped = u - std::floor(u);
    // Not acos(y), which has few distinct values near the poles.
    const float fromTop = std::atan2(std::hypot(direction.x, direction.z), direction.y);
    return {wrapped < 1.0F ? wrapped : 0.0F, std::min(fromTop / pi, 1.0F)};  // a tiny negative u wraps to 1
}

vec3 environmentDirection(const vec2& uv, float rotation) {
    const float aside = (uv.x - 0.5F) * 2.0F * pi - rotation;
    const float fromTop = uv.y * pi;
    return {std::sin(fromTop) * std::sin(aside), std::cos(fromTop), -std::sin(fromTop) * std::cos(aside)};
}

vec3 radianceFrom(const Environment& environment, const vec3& direction) {
    if (!environment.image) {
        return environment.radiance;
    }
    const FloatImage& image = *environment.image;
    const vec2 uv = environmentUv(direction, environment.rotation);
    const size_t texel = size_t{texelOf(uv.y, image.height)} * image.width + texelOf(uv.x, image.width);
    const float* values = &image.data[3 * texel];
    return environment.intensity * vec3(values[0], values[1], values[2]);
}

FloatImage readEnvironmentImage(const std::filesystem::path& path) {
    const std::string extension = inLowerCase(path.extension().string());
    if (extension != ".hdr" && extension != ".exr") {
        fail("{}: cannot be used as an environment: its name must end in .hdr or .exr (or be sky, studio or none)",
             path.string());
    }
    FloatImage image = extension == ".hdr" ? readHdr(path) : readExrColors(path);
    checkValues(path, image);
    return image;
}

}  // namespace reflet
