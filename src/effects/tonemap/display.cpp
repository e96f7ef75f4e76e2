// Records tone mapping for any display.
#include "effects/tonemap/display.h"

#include <cmath>

namespace reflet {

namespace {

const char* shaderFor(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8G8B8A8_UNORM:
            return "display_8.comp";
        case VK_FORMAT_A2B10G10R10_UNORM_PACK32:
            return "display_10.comp";
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return "display_half.comp";
        default:
            return "display_any.comp";
    }
}

}  // namespace

bool isPlainDisplayFormat(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_UNORM || format == VK_FORMAT_A2B10G10R10_UNORM_PACK32 ||
           format == VK_FORMAT_R16G16B16A16_SFLOAT;
}

gpu::Image displayFor(gpu::PassList& f, gpu::Image radiance, const TonemapSettings& settings, gpu::Image exposure,
                      const DisplayTarget& target) {
    const gpu::Image display = target.image ? target.image : f.image("display", target.format, radiance.size);
    f.compute("tonemap", shaderFor(display.format))
        .constant("curve", static_cast<uint32_t>(settings.curve))
        .constant("transfer", target.transfer)
        .constant("hasExposure", exposure ? 1U : 0U)
        .read("radiance", radiance)
        .read("exposure", exposure ? exposure : f.placeholder(VK_FORMAT_R32_SFLOAT))
        .write("display", display)
        .params(DisplayParams{radiance.size, target.offset, std::exp2(settings.exposure), target.paperWhite,
                              target.peakNits / target.paperWhite})
        .dispatch(radiance.size);
    return display;
}

}  // namespace reflet
