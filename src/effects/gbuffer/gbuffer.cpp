// Binds the G-buffer.
#include "effects/gbuffer/gbuffer.h"

namespace reflet {

gpu::ComputePass& bindReflectance(gpu::PassList& f, gpu::ComputePass& pass, const GBuffer& g) {
    return pass.constant("materialFeatures", g.features)
        .read("surfaceReflectance", g.reflectance ? g.reflectance : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT));
}

gpu::ComputePass& bindSurfaces(gpu::PassList& f, gpu::ComputePass& pass, const GBuffer& g) {
    return bindReflectance(f, pass, g)
        .read("surfaceLayers", g.layers ? g.layers : f.placeholder(VK_FORMAT_R32G32_UINT));
}

}  // namespace reflet
