// Transmissive surfaces (KHR_materials_transmission): screen-space refraction through layers of glass. Shared by C++
// and GLSL.
//
// Layers of transmissive surfaces are peeled like blended ones and composited back to front. A view ray is refracted at
// the layer's front face, and again at the nearest back face of the same material behind it, which is found in a depth
// image of back faces (C. Wyman, An Approximate Image-Space Approach for Interactive Refraction, SIGGRAPH 2005). From
// there it is traced like a reflection ray: on the screen, then by the sources that the settings enable.
#ifndef REFLET_RENDERER_GLASS_H
#define REFLET_RENDERER_GLASS_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define TRANSMISSION_SETTINGS(VALUE, SWITCH, CHOICE)                                                                \
    VALUE(uint, layers, 3, 0, 8,                                                                                    \
          "Glass surfaces (KHR_materials_transmission) that a pixel shows behind one another, the nearest ones "    \
          "first. More: right where more of them overlap, cost grows linearly. 0: drawn opaque.")                   \
    VALUE(uint, exitSteps, 4, 0, 16,                                                                                \
          "Steps that search the back face at which a refracted ray leaves a volume (KHR_materials_volume). More: " \
          "more exact for curved shapes. 0: a slab of the material's thickness.")
SETTINGS(TransmissionSettings, TRANSMISSION_SETTINGS)

struct GlassDrawParams {
    ViewParams view;
    uint medium;  // kind of the volume that the camera is in
};

const float frostedFrom = 0.05;  // roughness from which refracted light is blurred

struct RefractParams {
    ViewParams view;
    uint exitSteps;
    uint frosted;    // 1: rays of rough surfaces read prefiltered light (Ray.spread)
    float outerIor;  // around the volume that the camera is in
};

struct GlassOverParams {
    uvec2 size;
};

SHARED_END

#ifdef __cplusplus

#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/draw_list.h"
#include "renderer/glass/camera_medium.h"

namespace reflet {

/// Whether transmissive surfaces of the list are drawn as glass, apart from the opaque ones.
bool drawsGlass(const DrawList& list, const TransmissionSettings& settings, const MaterialsSettings& materials);

/// Material of a layer of transmissive surfaces, and its back faces.
struct GlassSurfaces {
    gpu::Image tint;  ///< RGBA16F: share of light that passes the surface, without reflection; thickness [m], negative
                      ///< where the camera sees the surface of the medium that it is in from inside
    gpu::Image volume;      ///< RGBA16F: extinction [1/m]; index of refraction
    gpu::Image kind;        ///< R32_UINT: MaterialParams::glass (glassKind), 0: none
    gpu::Image exitDepth;   ///< D32, reversed: nearest back face of that material behind the surface, 0: none
    gpu::Image exitNormal;  ///< R32_UINT: outward normal of that back face (packUnitVector)
};

/// g: of the layer, drawn with the same list, view and medium, which the camera is in.
GlassSurfaces glassSurfaces(gpu::PassList& f, const DrawList& list, const ViewParams& view, const GBuffer& g,
                            const std::optional<CameraMedium>& medium);

/// A ray for each pixel of the layer, or three where it disperses light, from where it leaves the glass.
struct RefractedRays {
    Rays rays;
    gpu::Image denoised;  ///< RGBA16F: denoised radiance of the rays of rough surfaces; none: not denoised
    /// RGBA16F: share of the ray's radiance that reaches the viewer; alpha: number of rays, 3: for red, green, blue.
    gpu::Image share;
};

/// Features of refractRays that are compiled in.
struct Refraction {
    bool disperses = false;   ///< some of the glass disperses light
    bool fromInside = false;  ///< the camera is in a medium
};

RefractedRays refractRays(gpu::PassList& f, const GBuffer& g, const GlassSurfaces& glass, gpu::Image ggxTable,
                          const Refraction& kinds, const RefractParams& params);

/// The view ray of each pixel of the layer, starting in front of it, for ray-traced paths that refract by themselves.
/// Light, tint and coverage are the layer's; the paths exclude them.
RefractedRays raysToGlass(gpu::PassList& f, const GBuffer& g, const GlassSurfaces& glass, const ViewParams& view);

/// Radiance of the first ray of each pixel, and its hit distance: RGBA16F.
gpu::Image answersOf(gpu::PassList& f, const Rays& rays);

/// over = the layer's own light plus the light that it transmits (none: opaque), composited over `behind` by the
/// layer's coverage. All RGBA16F. The alpha of `behind` is kept.
void glassOver(gpu::PassList& f, const GBuffer& g, gpu::Image layer, const RefractedRays* transmitted,
               gpu::Image behind, gpu::Image over);

}  // namespace reflet
#endif

#endif
