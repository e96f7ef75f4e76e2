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

// Alpha from which blended surfaces are opaque, 254.5 / 255, and below which they are not there.
const float opaqueAlpha = 0.998;
const float invisibleAlpha = 0.002;

// Relative difference of depths that counts as none in depth peeling.
const float peelTolerance = 1e-6;

// A transmissive material, in images: a number of its own from 1 in the lower bits, and its dispersion.
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
    vec3 f0;             // of the dielectric, over dielectricF0, without the factor that follows
    float f90;           // of the dielectric, 0..1; a factor of F0, too
    vec3 uvRows[38];     // two per slot, KHR_texture_transform
    float transmission;  // share of the light in the dielectric's base that passes the surface, 0: opaque
    float ior;
    vec3 extinction;      // of the volume beneath [1/m]
    float thickness;      // of that volume [m in object space]; 0: none, a sheet
    uint glass;           // glassKind of a transmissive material, else 0
    float coat;           // share of the surface beneath a clear coat, 0: none
    float coatRoughness;  // perceptual
    float coatNormalScale;
    vec3 sheenColor;
    float sheenRoughness;      // perceptual
    vec2 anisotropyAlong;      // direction of the anisotropy along tangent and bitangent, unit
    float anisotropy;          // its strength, 0..1
    float preExposed;          // 1: `emissive` is a live picture, whose radiance is pre-exposed; else 0
    uint emitter;              // 1: findEmitters has what it emits
    vec4 film;                 // thin film: share that it covers, index of refraction, least and largest thickness [nm]
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

/// number: of the material, from 1.
uint glassKind(const Material& material, uint number);

MaterialParams materialParams(const Material& material);

/// Bit mask of materialFeature….
uint materialFeatures(const Material& material);

}  // namespace reflet
#endif

#endif
