// Material parameters of shaders: raster draws bind them as set 1, ray hits read them from a buffer. Shared by C++ and
// GLSL.
#ifndef REFLET_RENDERER_MATERIAL_H
#define REFLET_RENDERER_MATERIAL_H

#include "base/shared.h"
#include "effects/gbuffer/gbuffer.h"

SHARED_BEGIN

// Slots of Material, in the order of the bindings 1..15 of set 1; binding 0 is this block.
const uint slotBaseColor = 0;
const uint slotMetallicRoughness = 1;
const uint slotNormal = 2;
const uint slotOcclusion = 3;
const uint slotEmissive = 4;
const uint slotSpecular = 5;
const uint slotSpecularColor = 6;
const uint slotTransmission = 7;
const uint slotThickness = 8;
const uint slotCoat = 9;
const uint slotCoatRoughness = 10;
const uint slotCoatNormal = 11;
const uint slotSheenColor = 12;
const uint slotSheenRoughness = 13;
const uint slotAnisotropy = 14;
const uint slotIridescence = 15;
const uint slotIridescenceThickness = 16;
const uint slotDiffuseTransmission = 17;
const uint slotDiffuseTransmissionColor = 18;
const uint slotCount = 19;
const uint sceneSlotCount = 8;  // the first ones, which ray hits read

// Alpha from which blended surfaces count as opaque, 254.5 / 255, and below which they are skipped.
const float opaqueAlpha = 0.998;
const float invisibleAlpha = 0.002;

// Relative difference of depths that depth peeling treats as equal.
const float peelTolerance = 1e-6;

// glassKind: a transmissive material in images, as a unique number from 1 in the lower bits, and its dispersion above.
const uint glassKindBits = 20;
const float glassDispersionSteps = 100.0;  // per 1

struct MaterialParams {
    vec4 baseColor;
    vec3 emissive;
    float alphaCutoff;
    float metallic;
    float roughness;
    float normalScale;
    float occlusionStrength;
    uint textured;       // bit per slot: has a texture
    uint secondUv;       // bit per slot: uses uv1
    uint blended;        // 1: alpha is coverage (Material::blended)
    uint unlit;          // 1: emits its base colour and reflects nothing
    vec3 f0;             // F0 of the dielectric, over dielectricF0, without the factor f90
    float f90;           // F90 of the dielectric, 0..1; also a factor of F0
    vec3 uvRows[38];     // two per slot, KHR_texture_transform
    float transmission;  // share of the light in the dielectric's base that passes the surface, 0: opaque
    float ior;
    vec3 extinction;      // extinction of the volume beneath [1/m]
    float thickness;      // thickness of that volume [m in object space]; 0: no volume, a thin sheet
    uint glass;           // glassKind of a transmissive material, else 0
    float coat;           // share of the surface that a clear coat covers, 0: none
    float coatRoughness;  // perceptual
    float coatNormalScale;
    vec3 sheenColor;
    float sheenRoughness;      // perceptual
    vec2 anisotropyAlong;      // direction of the anisotropy along tangent and bitangent, unit
    float anisotropy;          // its strength, 0..1
    float preExposed;          // 1: `emissive` is a live picture, whose radiance is pre-exposed; else 0
    uint emitter;              // 1: lamps from findEmitters replace its emission
    vec4 film;                 // thin film: coverage, index of refraction, least and largest thickness [nm]
    vec4 diffuseTransmission;  // its colour, and the share of the diffuse light that leaves on the other side
};

SHARED_END

#ifdef __cplusplus

#include "scene/scene.h"

#include <array>

namespace reflet {

/// The material's textures, in slot order.
std::array<const TextureSlot*, slotCount> textureSlots(const Material& material);

/// Whether the slot's colours are sRGB.
bool isSrgb(uint slot);

/// The value of MaterialParams::glass. number: of the material, from 1.
uint glassKind(const Material& material, uint number);

MaterialParams materialParams(const Material& material);

/// Bit mask of materialFeature….
uint materialFeatures(const Material& material);

}  // namespace reflet
#endif

#endif
