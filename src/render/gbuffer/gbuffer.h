// The G-buffer: geometry and material of the visible surface at each pixel, without lighting. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_GBUFFER_H
#define REFLET_RENDER_GBUFFER_H

#include "base/shared.h"
#include "render/view.h"

SHARED_BEGIN

#define MATERIALS_SETTINGS(VALUE, SWITCH, CHOICE)                                                                     \
    SWITCH(lambertOnly, 0,                                                                                            \
           "Shade every material as Lambert diffuse with its base colour: no specular lobe, no metals.")              \
    SWITCH(                                                                                                           \
        mips, 1,                                                                                                      \
        "Use texture mipmaps. Off: always the finest level, as the reference renders; needs many samples per pixel.") \
    VALUE(                                                                                                            \
        uint, anisotropy, 8, 1, 16,                                                                                   \
        "Maximum samples of anisotropic texture filtering. 1: off, blurry at grazing angles. More: sharper, slower.") \
    VALUE(float, mipBias, 0, -2, 2,                                                                                   \
          "Added to the texture mip level. Below 0: sharper; -1 to -2 suits temporal antialiasing, which averages "   \
          "jittered frames; flickers without it. Above 0: blurrier.")
SETTINGS(MaterialsSettings, MATERIALS_SETTINGS)

// Bits of the material image's alpha.
const uint materialFlagLambert = 1;
const uint materialFlagUnlit = 2;  // emits the base colour, reflects nothing

// What is drawn, as the specialization constant `surfaces`.
const uint surfacesOpaque = 0;   // and blended ones from an alpha of blendedFrom on
const uint surfacesNearest = 1;  // the nearest translucent ones in front of the opaque ones
const uint surfacesBehind = 2;   // the next ones, behind those of another layer

struct GBufferParams {
    ViewParams view;
    MaterialsSettings settings;
    vec4 clipPlane;     // world space: only geometry in front of it, dot(clipPlane, (p, 1)) > 0, is drawn
    float blendedFrom;  // alpha from which blended surfaces are drawn with the opaque ones
};

SHARED_END

#ifdef __cplusplus

#include "gpu/recorder.h"
#include "render/draw_list.h"
#include "render/material.h"

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
    gpu::Image material;   ///< RGBA8: perceptual roughness, metallic, occlusion, flags / 255
    gpu::Image emissive;   ///< B10G11R11: emitted radiance
    gpu::Image motion;     ///< RGBA16F: uv now minus uv last frame; the surface's own motion away from the camera along
                           ///< its axis [m], exactly 0 at rest; alpha of blended surfaces, else 0
    gpu::Image reflectance{};  ///< RGBA16F: F0 of the dielectric over 4 %, F90; null unless a material differs from 1
    uint32_t features = 0;     ///< materialFeature… of the draw list
};

/// Owns the images of a G-buffer.
struct GBufferStore {
    gpu::KeptImage depth{"depth"};
    gpu::KeptImage normal{"normal"};
    gpu::KeptImage geometricNormal{"geometric_normal"};
    gpu::KeptImage baseColor{"base_color"};
    gpu::KeptImage material{"material"};
    gpu::KeptImage emissive{"emissive"};
    gpu::KeptImage motion{"motion"};
    gpu::KeptImage reflectance{"reflectance"};
};

/// What of the draw list a G-buffer holds.
struct GBufferContent {
    vec4 clipPlane{0.0F};             ///< as in GBufferParams; zero: none
    float blendedFrom = opaqueAlpha;  ///< alpha from which blended surfaces count as opaque
    gpu::Image opaqueDepth{};         ///< given: translucent surfaces in front of this; none: opaque surfaces
    gpu::Image nearerDepth{};         ///< given: of those the nearest ones behind this; none: the nearest ones
};

/// Draws the list for the view: reversed Z, back faces of single-sided draws culled. Layers of blended surfaces are
/// found by depth peeling (C. Everitt, Interactive Order-Independent Transparency, 2001). Clipping is done per pixel,
/// because an oblique near plane (Lengyel, Oblique View Frustum Depth Projection and Clipping, 2005) would distort
/// depth, and ray marching relies on distance = near / depth.
GBuffer drawGBuffer(gpu::Recorder& f, GBufferStore& own, const DrawList& list, const ViewParams& view,
                    const MaterialsSettings& settings, const GBufferContent& content = {});

/// Specializes a pass whose shader includes gbuffer_surface.glsl, and binds what that reads.
gpu::Pass& bindSurfaces(gpu::Recorder& f, gpu::Pass& pass, const GBuffer& g);

}  // namespace reflet
#endif

#endif
