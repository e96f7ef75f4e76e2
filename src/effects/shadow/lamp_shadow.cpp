// Records the lookup of the lamps' shadow maps.
#include "effects/shadow/lamp_shadow.h"

#include <algorithm>

namespace reflet {

gpu::Image lampVisibility(gpu::PassList& f, const GBuffer& g, const LampShadowInputs& in, const LampShadows& shadows,
                          const LampVisibilityParams& params) {
    const uint32_t layers = (shadows.count + 3) / 4;
    const gpu::Image visibility =
        f.image("lamp_visibility", VK_FORMAT_R8G8B8A8_UNORM, g.depth.size, layers, /*array=*/true);
    const auto anyOfType = [&](uint32_t type) {
        return std::any_of(shadows.lamps, shadows.lamps + shadows.count,
                           [=](const LampShadow& shadow) { return shadow.lamp.type == type; });
    };
    f.compute("lamp_visibility", "lamp_visibility.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("shadowMap", in.map)
        .read("lampMasks", in.masks)
        .read("blueNoise", in.blueNoise)
        .write("visibility", visibility)
        .params(params)
        .params(shadows, "shadowBlock")
        .constant("anyEmitters", 0U)  // several may share a map, so these shine in all directions
        .constant("anyReflected", anyOfType(lampReflected) ? 1U : 0U)
        .constant("anyDistant", anyOfType(lampDirectional) ? 1U : 0U)
        .constant("filterKind", static_cast<uint32_t>(params.settings.filter))
        .dispatch(visibility.size);
    return visibility;
}

}  // namespace reflet
