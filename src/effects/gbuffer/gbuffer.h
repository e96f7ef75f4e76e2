// The G-buffer: geometry and material of the visible surface at each pixel, without lighting. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_GBUFFER_H
#define REFLET_EFFECTS_GBUFFER_H

#include "base/shared.h"

SHARED_BEGIN

// Bits of the material image's alpha.
const uint materialFlagLambert = 1;
const uint materialFlagUnlit = 2;    // emits the base colour, reflects nothing
const uint materialFlagEmitter = 4;  // with DirectSettings.emitters lamps stand for what it emits

// What shaders are specialized for, because any material that is drawn has it.
const uint materialFeatureReflectance = 1;  // the dielectric's F0 is not 4 % of all light, or its F90 is not 1
const uint materialFeatureUnlit = 2;
const uint materialFeatureSheen = 4;
const uint materialFeatureAnisotropy = 8;

SHARED_END

#ifdef __cplusplus

#include "gpu/pass_list.h"

namespace reflet {

/// Images of the view's size.
struct GBuffer {
    gpu::Image depth;   ///< D32, reversed, 0: sky
    gpu::Image normal;  ///< R32_UINT: world-space shading normal, octahedral, two snorm16 (packUnitVector). Vulkan does
                        ///< not guarantee RG16 snorm as a colour target, and SwiftShader lacks it
    gpu::Image geometricNormal;  ///< R32_UINT, packed alike: of the triangle, facing the camera; matches the depth
                                 ///< gradient, unlike smooth or mapped normals
    gpu::Image baseColor;  ///< RGB10A2: square root of the linear base colour. Error up to 0.15 %, against 0.8 % for
                           ///< RGBA8 sRGB in the same four bytes (llvmpipe, base colour 0.5)
    gpu::Image material;   ///< RGBA8: perceptual roughness (of anisotropic surfaces that of the geometric mean of
                           ///< both alphas), metallic, occlusion, flags / 255
    gpu::Image emissive;   ///< B10G11R11: emitted radiance, pre-exposed
    gpu::Image motion;     ///< RGBA16F: uv now minus uv last frame; the surface's own motion away from the camera along
                           ///< its axis [m], exactly 0 at rest; alpha of blended surfaces, coverage of glass, share of
                           ///< clear coats, else 0
    gpu::Image reflectance{};  ///< RGBA16F: F0 of the dielectric over 4 %, F90; null unless a material differs from 1
    gpu::Image layers{};       ///< RG32_UINT: sheen and anisotropy (packLayers); null unless a material has either
    uint32_t features = 0;     ///< materialFeature… of the draw list
};

/// Specializes a pass whose shader includes gbuffer_surface.glsl, and binds what that reads.
gpu::ComputePass& bindSurfaces(gpu::PassList& f, gpu::ComputePass& pass, const GBuffer& g);

/// The same for a shader that uses no more of it than dielectricAt.
gpu::ComputePass& bindReflectance(gpu::PassList& f, gpu::ComputePass& pass, const GBuffer& g);

}  // namespace reflet
#endif

#endif
