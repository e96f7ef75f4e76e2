// Direct light: sun and lamps on the G-buffer, plus emission and background. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_DIRECT_H
#define REFLET_EFFECTS_DIRECT_H

#include "base/shared.h"
#include "effects/lamps.h"
#include "effects/view.h"

SHARED_BEGIN

struct DirectParams {
    ViewParams view;
    vec3 toSun;
    vec3 sunIrradiance;       // on a surface that faces it [W/m²]
    float sunRoughness;       // perceptual, of a lobe about as wide as the sun's disk: highlights are no sharper
    float roughestHighlight;  // of emitters (shaders/emitter_highlight.glsl); 0: none
};

SHARED_END

#ifdef __cplusplus

#include "effects/environment/environment_light.h"
#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// The GGX directional albedo table (RGBA16F, 32x32: A, B, albedo of a sheen; see ggx_table.comp). Computed in the
/// first frame.
gpu::Image ggxTable(gpu::PassList& f, gpu::KeptImage& own);

/// Light visibility per pixel.
struct LightVisibility {
    gpu::Image sun;
    gpu::Image lamps;      ///< a layer per four lamps, by LampParams::shadow; none if no lamp casts a shadow
    gpu::Image lampMasks;  ///< from findLampTiles
};

/// Light sources other than the sun.
struct DirectLights {
    const LampBlock& lamps;
    const EnvironmentLight& environment;  ///< the background
    bool lambertOnly = false;             ///< MaterialsSettings
    bool hidesSunInMirrors = false;       ///< smooth mirrors do not reflect the sun
};

/// RGBA16F, alpha 1.
struct DirectLight {
    gpu::Image all;           ///< radiance of sun and lamps, emission and background
    gpu::Image fromEmitters;  ///< part of `all`: light of lamps that represent emissive surfaces or the sun in mirrors,
                              ///< without highlights of emitters; none without these
    gpu::Image highlights;    ///< part of `all`: highlights of emitters; none without these
};

DirectLight directLight(gpu::PassList& f, const GBuffer& g, const LightVisibility& visibility, gpu::Image ggxTable,
                        const DirectParams& params, const DirectLights& lights);

}  // namespace reflet
#endif

#endif
