// Applies the surfaces' reflectance to the lobes' light, upsamples it if needed, and adds it to the direct light.
// Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_COMPOSITE_H
#define REFLET_EFFECTS_COMPOSITE_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define COMPOSITE_SETTINGS(VALUE, SWITCH, CHOICE)                                                                     \
    SWITCH(direct, 1,                                                                                                 \
           "Include direct light and emission in the image. Off: only indirect light is shown; it is computed as "    \
           "before.")                                                                                                 \
    SWITCH(layers, 1,                                                                                                 \
           "Keep diffuse GI and reflections as separate layers (AOVs). `render` and `bench` set this by themselves, " \
           "only if the layers are asked for.")
SETTINGS(CompositeSettings, COMPOSITE_SETTINGS)

struct CompositeParams {
    ViewParams view;
    float diffuseGain;        // factor on indirect diffuse light
    uint diffuseBlockOffset;  // traced pixel of a block, along each side (RaySurfaces)
    uint specularBlockOffset;
    vec2 diffuseShift;  // LobeLight.shift
    vec2 specularShift;
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "effects/lobe/rays.h"
#include "gpu/pass_list.h"

namespace reflet {

struct CompositeInputs {
    GBuffer g;
    gpu::Image direct;
    LobeLight diffuse;  ///< lobes at reduced resolution are upsampled
    LobeLight specular;
    gpu::Image ggxTable;
    bool lambertOnly = false;   ///< MaterialsSettings
    bool layers = true;         ///< false: only the sum is written
    gpu::Image fromEmitters{};  ///< with layers, the part of `direct` that goes to indirect diffuse light; may be none
    gpu::Image highlights{};    ///< the same, that goes to indirect specular light
    gpu::Image limits{};        ///< of LightBound, of the sum; may be none
};

/// Radiance, of one frame (RGBA16F) or means over several: lit = direct + indirectDiffuse + indirectSpecular.
struct LightLayers {
    gpu::Image direct;
    gpu::Image indirectDiffuse;  ///< none without layers
    gpu::Image indirectSpecular;
    gpu::Image lit;
};

/// Sets the block offsets of params. lit: written.
LightLayers composite(gpu::PassList& f, const CompositeInputs& in, gpu::Image lit, CompositeParams params);

/// lit - direct, of the same size, at least 0.
gpu::Image withoutDirect(gpu::PassList& f, gpu::Image lit, gpu::Image direct);

}  // namespace reflet
#endif

#endif
