// Binds the G-buffer.
#include "effects/gbuffer/gbuffer.h"

namespace reflet {

gpu::Pass& bindReflectance(gpu::Recorder& f, gpu::Pass& pass, const GBuffer& g) {
    return pass.constant("materialFeatures", g.features)
        .read("surfaceReflectance", g.reflectance ? g.reflectance : f.placeholder(VK_FORMAT_R16G16B16A16_SFLOAT));
}

gpu::Pass& bindSurfaces(gpu::Recorder& f, gpu::Pass& pass, const GBuffer& g) {
    return bindReflectance(f, pass, g)
        .read("surfaceLayers", g.layers ? g.layers : f.placeholder(VK_FORMAT_R32G32_UINT));
}

}  // namespace reflet
