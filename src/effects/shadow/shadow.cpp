// Records the lookup of the sun's shadow maps.
#include "effects/shadow/shadow.h"

namespace reflet {

gpu::ComputePass& bindShadowMap(gpu::ComputePass& pass, const ShadowMap& map) {
    if (map.ofHost) {
        pass.constant("hostIsReversed", map.reversed ? 1 : 0);
    }
    return pass.read("shadowMap", map.image);
}

SunVisibility sunVisibility(gpu::PassList& f, const GBuffer& g, const ShadowInputs& in,
                            const ShadowVisibilityParams& params) {
    const ShadowFilter filter = params.settings.filter;
    const bool soft = filter == ShadowFilter::pcf || filter == ShadowFilter::pcss;
    const bool cascades = params.sun.count > 1;
    // Always bound, but unused where not needed.
    const auto imageIf = [&](bool needed, const char* name, VkFormat format) {
        return needed ? f.image(name, format, g.depth.size) : f.placeholder(format);
    };
    const ShadowMap map = in.map ? in.map : ShadowMap{g.depth};
    constexpr ShadowShaders shaders{"shadow_visibility.comp", "shadow_visibility_host.comp",
                                    "shadow_visibility_layers.comp"};
    const gpu::Image penumbra = imageIf(soft, "shadow_penumbra", VK_FORMAT_R16G16_SFLOAT);
    const gpu::Image index = imageIf(cascades, "cascade_index", VK_FORMAT_R8_UNORM);
    const gpu::Image visibility = f.image("sun_visibility", VK_FORMAT_R8_UNORM, g.depth.size);
    gpu::ComputePass pass = f.compute("shadow_visibility", shaders.of(map));
    bindShadowMap(pass, map)
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("range", in.range ? in.range : g.depth)
        .read("blueNoise", in.blueNoise)
        .write("visibility", visibility)
        .write("penumbra", penumbra)
        .write("cascadeIndex", index)
        .params(params)
        .constant("filterKind", static_cast<uint32_t>(filter))
        .constant("hasRanges", in.range ? 1 : 0)
        .constant("cascades", params.sun.count)
        .constant("biasKind", static_cast<uint32_t>(params.settings.biasKind))
        .dispatch(g.depth.size);
    return {visibility, soft ? penumbra : gpu::Image{}, cascades ? index : gpu::Image{}};
}

}  // namespace reflet
