// Ambient occlusion (AO) in screen space: the cosine-weighted share of unoccluded directions, and their mean direction,
// the bent normal. It attenuates prefiltered light of environment and probes, which ignores nearby occluders; never
// direct light, and not light of traced rays, which find occluders themselves. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_AMBIENT_OCCLUSION_H
#define REFLET_EFFECTS_AMBIENT_OCCLUSION_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define AO_METHODS(OPTION)       \
    OPTION(AoMethod, none, 0)    \
    OPTION(AoMethod, horizon, 1) \
    OPTION(AoMethod, bitmask, 2)
CHOICES(AoMethod, AO_METHODS)

#define AO_THICKNESSES(OPTION)       \
    OPTION(AoThickness, constant, 0) \
    OPTION(AoThickness, growing, 1)  \
    OPTION(AoThickness, secondLayer, 2)
CHOICES(AoThickness, AO_THICKNESSES)

#define AO_SETTINGS(VALUE, SWITCH, CHOICE)                                                                             \
    CHOICE(                                                                                                            \
        AoMethod, method, none,                                                                                        \
        "Ambient occlusion (AO) in screen space. horizon: everything below a surface is covered (horizon-based, "      \
        "GTAO). "                                                                                                      \
        "bitmask: light passes behind surfaces of limited thickness (visibility bitmask), so thin things shade less. " \
        "Dims light of environment and probes only where it is prefiltered: diffuse light with "                       \
        "diffuse.distribution=normal, and cones of specular.rough_fallback=mips. Never direct light, and not "         \
        "traced diffuse light, which is occluded by itself. Shown by --show ambient_occlusion and bent_normal.")       \
    VALUE(uint, slices, 2, 1, 16, "Slices of the hemisphere per traced pixel. More: less noise, cost grows linearly.") \
    VALUE(uint, steps, 6, 1, 64,                                                                                       \
          "Steps to each side of a slice. More: thin and small occluders are missed less often, cost grows linearly.") \
    VALUE(float, radius, 1.0, 0.001, 10000.0,                                                                          \
          "Metres: occluders farther away do not count. Smaller: only creases; larger: whole rooms get darker.")       \
    VALUE(float, falloff, 0.0, 0.0, 1.0,                                                                               \
          "Fraction of the radius over which occluders fade out, at its end. 0: they count fully up to the radius.")   \
    VALUE(                                                                                                             \
        float, thickness, 0.3, 0.001, 1000.0,                                                                          \
        "Assumed thickness of surfaces along the view (bitmask): metres, or metres per metre of distance (growing). "  \
        "Too small: light leaks through; too large: thin things cast too much shade.")                                 \
    CHOICE(AoThickness, thicknessMode, constant,                                                                       \
           "How thick surfaces are taken to be (bitmask). constant: `thickness`. growing: in proportion to the "       \
           "occluder's "                                                                                               \
           "distance. second_layer: up to the back face; draws the scene's back faces as well.")                       \
    VALUE(                                                                                                             \
        uint, downsample, 1, 1, 4,                                                                                     \
        "Trace at reduced resolution: one pixel of each NxN block. 2: a quarter of the cost. Upsampled by depth and "  \
        "normal.")                                                                                                     \
    SWITCH(multiBounce, 0,                                                                                             \
           "Brighten occluded places by the light between nearby surfaces, estimated from the surface's own albedo "   \
           "(Jimenez "                                                                                                 \
           "et al. 2016). An approximation: off for comparisons.")
SETTINGS(AoSettings, AO_SETTINGS)

struct FinishAoParams {
    ViewParams view;
    uint blockOffset;  // traced pixel of a block, along each side
    vec2 shift;        // LobeLight.shift
};

SHARED_END

#ifdef __cplusplus

#include "effects/denoise/denoise.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/lobe/rays.h"

namespace reflet {

struct AoInputs {
    const GBuffer& g;
    const ViewParams& view;
    gpu::Image backDepth;  ///< for AoThickness::secondLayer
    AoSettings settings;
    DenoiseSettings denoise;
    gpu::Image ggxTable;
    gpu::BufferView blueNoise;
};

/// RGBA16F: bent normal (world space, unit: mean unoccluded direction), visibility: 1 unoccluded, 0 fully occluded;
/// visibility 1 and a zero vector in the background. None with AoMethod::none. own: as of denoise().
gpu::Image ambientOcclusion(gpu::PassList& f, DenoiseStore* own, const AoInputs& in);

/// Binds the result, which may be none, to a pass that includes ambient_visibility.glsl. scale: of the RaySurfaces
/// whose pixels the pass looks up.
gpu::ComputePass& bindAmbientOcclusion(gpu::PassList& f, gpu::ComputePass& pass, gpu::Image result, uint32_t scale);

}  // namespace reflet
#endif

#endif
