// Records the resampling of histories.
#include "effects/rescale/rescale.h"

#include "base/error.h"
#include "effects/lobe/ray_surfaces.h"

#include <algorithm>
#include <array>

namespace reflet {

namespace {

struct Shader {
    VkFormat format;
    const char* name;
};

constexpr std::array shaders{Shader{VK_FORMAT_R16G16B16A16_SFLOAT, "rescale_light.comp"},
                             Shader{VK_FORMAT_R16G16_SFLOAT, "rescale_moments.comp"},
                             Shader{VK_FORMAT_R32_SFLOAT, "rescale_scalar.comp"},
                             Shader{VK_FORMAT_R8_UNORM, "rescale_mark.comp"},
                             Shader{VK_FORMAT_R32G32_SFLOAT, "rescale_pair.comp"},
                             Shader{VK_FORMAT_R32G32_UINT, "rescale_packed.comp"}};

// Of an image that has a texel for each block of pixels, and shows one pixel of it (blockPixelOffset).
vec2 centreOf(uvec2 frame, uvec2 size) {
    const uvec2 blocks = (frame + size - 1U) / size;
    const uint32_t scale = std::max({blocks.x, blocks.y, 1U});
    return vec2((static_cast<float>(blockPixelOffset(scale)) + 0.5F) / static_cast<float>(scale));
}

}  // namespace

void rescaleHistory(gpu::PassList& f, const gpu::Image& from, const gpu::Image& to, gpu::Resample resample) {
    const auto* const shader = std::ranges::find(shaders, from.format, &Shader::format);
    REFLET_CHECK(shader != shaders.end(), "no history of VkFormat {} is resampled", static_cast<int>(from.format));
    gpu::ComputePass pass = f.compute("rescale", shader->name);
    if (from.format == VK_FORMAT_R16G16B16A16_SFLOAT) {
        pass.constant("nearest", resample == gpu::Resample::nearest ? 1U : 0U);
    }
    if (from.format == VK_FORMAT_R32G32_UINT) {
        pass.constant("depthInGreen", resample == gpu::Resample::depthInGreen ? 1U : 0U);
    }
    const vec2 ratio = vec2(f.sizes().before) / vec2(f.sizes().now);
    pass.read("from", from)
        .write("to", to)
        .params(RescaleParams{from.size, to.size, ratio, centreOf(f.sizes().before, from.size)})
        .dispatch(to.size);
}

std::span<const VkFormat> rescaledFormats() {
    static constexpr std::array formats = [] {
        std::array<VkFormat, shaders.size()> all{};
        std::ranges::transform(shaders, all.begin(), &Shader::format);
        return all;
    }();
    return formats;
}

}  // namespace reflet
