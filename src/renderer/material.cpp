// Converts scene materials to shader parameters.
#include "renderer/material.h"

#include <algorithm>
#include <cmath>

namespace reflet {

std::array<const TextureSlot*, slotCount> textureSlots(const Material& m) {
    return materialTextures(m);  // in the order of the slots
}

bool isSrgb(uint slot) {
    // The specular slots often share one image: sRGB decoding leaves alpha as it is.
    return slot == slotBaseColor || slot == slotSheenColor || slot == slotDiffuseTransmissionColor ||
           (slot >= slotEmissive && slot <= slotSpecularColor);
}

namespace {

// Fresnel's equations at normal incidence, over dielectricF0 of ggx.glsl, which is that of 1.5: exactly 1 there.
float dielectricF0Over4Percent(float ior) {
    const double root = (double(ior) - 1.0) / (double(ior) + 1.0);
    return static_cast<float>(25.0 * root * root);
}

}  // namespace

uint glassKind(const Material& material, uint number) {
    constexpr uint most = (1U << (32 - glassKindBits)) - 1;
    const float dispersion = std::min(material.transmission.dispersion * glassDispersionSteps, float(most));
    return (number & ((1U << glassKindBits) - 1)) | static_cast<uint>(std::lround(dispersion)) << glassKindBits;
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
    p.unlit = m.unlit ? 1U : 0U;
    // The reflectance of glass at grazing incidence vanishes with the difference of the indices of refraction.
    const float f0 = dielectricF0Over4Percent(m.ior);
    const float most = m.transmission.factor > 0.0F ? std::clamp(2.0F * f0, 1e-3F, 1.0F) : 1.0F;
    p.f0 = glm::min(f0 / most * m.specularColor, 1e6F);  // infinity times 0 would be a NaN
    p.f90 = m.specular * most;
    p.transmission = m.transmission.factor;
    p.ior = m.ior;
    p.extinction = -glm::log(glm::max(m.transmission.attenuationColor, 1e-6F)) /
                   std::max(m.transmission.attenuationDistance, 1e-6F);
    p.thickness = m.transmission.thickness;
    p.coat = m.clearcoat.factor;
    p.coatRoughness = m.clearcoat.roughness;
    p.coatNormalScale = m.clearcoat.normalScale;
    p.sheenColor = m.sheen.color;
    p.sheenRoughness = m.sheen.roughness;
    p.anisotropyAlong = {std::cos(m.anisotropy.rotation), std::sin(m.anisotropy.rotation)};
    p.anisotropy = m.anisotropy.strength;
    p.film = {m.iridescence.factor, m.iridescence.ior, m.iridescence.thinnest, m.iridescence.thickest};
    p.diffuseTransmission = vec4(m.diffuseTransmission.color, m.diffuseTransmission.factor);
    const auto slots = textureSlots(m);
    for (size_t i = 0; i < slotCount; ++i) {
        p.textured |= slots[i]->image >= 0 ? 1U << i : 0U;
        p.secondUv |= slots[i]->uvSet == 1 ? 1U << i : 0U;
        p.uvRows[2 * i] = slots[i]->uvTransform[0];
        p.uvRows[2 * i + 1] = slots[i]->uvTransform[1];
    }
    return p;
}

uint materialFeatures(const Material& m) {
    const MaterialParams p = materialParams(m);
    const bool textured = (p.textured & (1U << slotSpecular | 1U << slotSpecularColor)) != 0;
    const bool reflectance = textured || p.f0 != vec3(1.0F) || p.f90 != 1.0F || m.iridescence.factor > 0.0F;
    return (reflectance ? materialFeatureReflectance : 0U) | (m.unlit ? materialFeatureUnlit : 0U) |
           (m.sheen.color != vec3(0.0F) ? materialFeatureSheen : 0U) |
           (m.anisotropy.strength > 0.0F ? materialFeatureAnisotropy : 0U);
}

}  // namespace reflet
