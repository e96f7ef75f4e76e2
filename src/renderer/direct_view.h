// One camera's view under direct light: G-buffer, visibility of sun and lamps, radiance. The first half of the frame,
// also used for planar views and probe faces.
#pragma once

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/direct/direct.h"
#include "effects/direct/lamp_tiles.h"
#include "effects/environment/environment_light.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/shadow/lamp_shadow.h"
#include "effects/shadow/shadow.h"
#include "effects/shadow/shadow_clean.h"
#include "gpu/recorder.h"
#include "renderer/blend/blend_shadow.h"
#include "renderer/draw_list.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/probe/probes.h"
#include "renderer/settings.h"
#include "renderer/trace_scene/direct_rays.h"
#include "renderer/trace_scene/trace_scene.h"

namespace reflet {

struct ViewInputs {
    const DrawList& draws;
    ViewParams view;
    vec3 sunDirection{0, -1, 0};      ///< direction of travel of the light, unit
    vec3 sunIrradiance{0.0F};         ///< on a surface that faces the sun [W/m²]; 0: no sun
    float sunAngularDiameter = 0.0F;  ///< radians
    EnvironmentLight environment;     ///< of EnvironmentMaps::update
    const LampBlock& lamps;
    const LampShadows& lampShadows;       ///< of planLampShadows
    gpu::Image ggxTable;                  ///< of ggxTable
    gpu::BufferView blueNoise;            ///< of blueNoise()
    const TracedScene* traced = nullptr;  ///< BVH; only if the settings trace the scene (tracesScene)
    double time = 0.0;                    ///< of the scene's animations [s]
    ProbeMaps probes{};                   ///< probes for rays; may be empty
    vec4 clipPlane{0.0F};                 ///< as for drawGBuffer; zero: none
};

/// Formats are documented with the effects.
struct ViewImages {
    GBuffer g;
    gpu::Image drawnDepth;        ///< depth of `g` before depth.format, D32
    gpu::Image backDepth;         ///< none unless trace_screen.thickness_mode is second_layer
    gpu::Image pyramid;           ///< none unless trace_screen.method is hiz or there are contact shadows
    gpu::Image shadowMap;         ///< none without sun or shadows
    gpu::Image shadowRange;       ///< its min/max pyramid; none unless it is used
    SunShadowParams sun{};        ///< its cascades
    BlendShadowMaps blendShadow;  ///< none without sun, shadows or blended surfaces
    gpu::Image rawSunVisibility;  ///< before denoising
    gpu::Image sunVisibility;     ///< as used by direct light
    gpu::Image shadowPenumbra;    ///< of sunVisibility(); none with hard shadows
    gpu::Image cascadeIndex;      ///< of sunVisibility(); none with one cascade
    gpu::Image lampShadowMap;     ///< none if no lamp casts a shadow
    LampTiles lampTiles;          ///< of all lamps
    gpu::Image lampVisibility;    ///< none if no lamp casts a shadow
    gpu::Image direct;
    gpu::Image ambientOcclusion;  ///< none without AO
};

/// Lights for shading at hits of traced rays.
SceneLights sceneLights(const ViewInputs& in, const Settings& settings);

/// What one view keeps for the next frame: shadow maps as long as they hold, and histories.
struct DirectViewStore {
    gpu::KeptImage shadowMap{"shadow_map"};
    gpu::KeptImage shadowRange{"shadow_range"};
    BlendShadowStore blendShadow;
    gpu::KeptImage lampShadowMap{"lamp_shadow_map"};
    gpu::HistoryImage sunVisibility{"shadow_clean.history"};
    DenoiseStore ambientOcclusion;
};

/// Records the passes of one view. lampShadowMap: from another view of the same frame, to be shared; none: it is drawn.
ViewImages directView(gpu::Recorder& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                      gpu::Image lampShadowMap = {});

/// The same for given surfaces: visibility and direct light at out.g. Shadow maps that `out` has are used. own: none:
/// `out` has all of them, and there is no history.
void lightSurfaces(gpu::Recorder& f, DirectViewStore* own, const ViewInputs& in, const Settings& settings,
                   ViewImages& out);

}  // namespace reflet
