// Uploads the environment's image.
#include "renderer/environment_maps/environment_maps.h"

#include "base/color.h"
#include "base/exposure.h"
#include "gpu/context.h"
#include "scene/sky.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

// Powers of two, of an image that is as bright as most. A larger one would lose the dim parts of an image that contains
// the sun.
constexpr int largestScale = 10;
constexpr int smallestScale = -20;

// A power of two that brings the brightest value into the range of half floats.
float scaleFor(const FloatImage& image) {
    const float brightest = *std::ranges::max_element(image.data);
    if (brightest <= 0.0F) {
        return 1.0F;
    }
    const int typical = -static_cast<int>(std::log2(preExposureFor(luminance(meanRadiance(image)))));
    const int power = static_cast<int>(std::ceil(std::log2(brightest / largestHalf)));
    return std::exp2(static_cast<float>(std::clamp(power, typical + smallestScale, typical + largestScale)));
}

std::vector<uint64_t> halfTexels(const FloatImage& image, float scale) {
    std::vector<uint64_t> texels;
    texels.reserve(image.data.size() / 3);
    for (size_t i = 0; i + 2 < image.data.size(); i += 3) {
        const vec3 radiance = vec3(image.data[i], image.data[i + 1], image.data[i + 2]) / scale;
        texels.push_back(glm::packHalf4x16(vec4(glm::min(radiance, vec3(largestHalf)), 1.0F)));
    }
    return texels;
}

const FloatImage& whiteImage() {
    static const FloatImage white{1, 1, {"R", "G", "B"}, {1.0F, 1.0F, 1.0F}};
    return white;
}

}  // namespace

void EnvironmentMaps::load(gpu::PassList& f) {
    const FloatImage& image = image_ ? *image_ : whiteImage();
    scale_ = image_ ? scaleFor(image) : 1.0F;
    const gpu::Image texels = texels_.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(image.width, image.height));
    const std::vector<uint64_t> halves = halfTexels(image, scale_);
    f.upload(texels, std::as_bytes(std::span(halves)));
    if (!prefilters_) {
        return;
    }
    lighting::prefilterEnvironment(f, cube_, texels, image_ ? image.width : 0);
}

EnvironmentLight EnvironmentMaps::update(gpu::PassList& f, const Environment& environment) {
    if (!texels_.last() || image_ != environment.image) {
        image_ = environment.image;
        load(f);
    }
    const vec3 factor = image_ ? vec3(environment.intensity * scale_) : environment.radiance;
    const float angle = image_ ? environment.rotation : 0.0F;
    return {texels_.last(), cube_.lobes.image(), cube_.irradiance.image(), lighting::environmentParams(factor, angle)};
}

}  // namespace reflet
