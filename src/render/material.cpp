// Converts scene materials to shader parameters.
#include "render/material.h"

namespace reflet {

std::array<const TextureSlot*, slotCount> textureSlots(const Material& m) {
    return {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.occlusionTexture,
            &m.emissiveTexture};
}

bool isSrgb(uint slot) {
    return slot == slotBaseColor || slot == slotEmissive;
}

MaterialParams materialParams(const Material& m) {
    MaterialParams p{};
    p.baseColor = m.baseColor;
    p.emissive = m.emissive;
    p.alphaCutoff = m.alphaCutoff;
    p.blended = m.blended ? 1U : 0U;
    p.metallic = m.metallic;
    p.roughness = m.roughness;
    p.normalScale = m.normalScale;
    p.occlusionStrength = m.occlusionStrength;
    const auto slots = textureSlots(m);
    for (size_t i = 0; i < slotCount; ++i) {
        p.textured |= slots[i]->image >= 0 ? 1U << i : 0U;
        p.secondUv |= slots[i]->uvSet == 1 ? 1U << i : 0U;
        p.uvRows[2 * i] = slots[i]->uvTransform[0];
        p.uvRows[2 * i + 1] = slots[i]->uvTransform[1];
    }
    return p;
}

}  // namespace reflet
