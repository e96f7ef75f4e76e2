// Binds lobes to passes that upsample them.
#include "effects/lobe/upsample.h"

namespace reflet {

uint32_t upsampledScale(const LobeLight& light) {
    return light.dark ? 0 : light.from.scale;
}

gpu::Image surfacesToUpsample(gpu::PassList& f, const LobeLight& light, gpu::Image image, VkFormat format) {
    return light.from.scale > 1 ? image : f.placeholder(format);
}

gpu::ComputePass& bindUpsampledSpecular(gpu::PassList& f, gpu::ComputePass& pass, const LobeLight& specular) {
    const GBuffer& g = specular.from.g;
    return pass.constant("specularScale", upsampledScale(specular))
        .read("specular", specular.radiance)
        .read("specularDepth", surfacesToUpsample(f, specular, g.depth, VK_FORMAT_R32_SFLOAT))
        .read("specularNormal", surfacesToUpsample(f, specular, g.normal, VK_FORMAT_R32_UINT));
}

}  // namespace reflet
