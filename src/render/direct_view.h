// What one camera sees under direct light: G-buffer, visibility of sun and lamps, radiance. The first half of the
// frame, for its camera and for views besides (mirrored ones, the faces of probes).
#pragma once

#include "gpu/frame.h"
#include "render/direct/direct.h"
#include "render/direct/lamp_tiles.h"
#include "render/draw_list.h"
#include "render/environment/environment_light.h"
#include "render/gbuffer/gbuffer.h"
#include "render/probe/probes.h"
#include "render/settings.h"
#include "render/shadow/lamp_shadow.h"
#include "render/trace_scene/trace_scene.h"

namespace reflet {

struct ViewInputs {
    const DrawList& draws;
    ViewParams view;
    vec3 sunDirection{0, -1, 0};      ///< the way the light travels, unit
    vec3 sunIrradiance{0.0F};         ///< on a surface that faces the sun [W/m²]; 0: no sun
    float sunAngularDiameter = 0.0F;  ///< radians
    EnvironmentLight environment;     ///< of EnvironmentMaps::update
    const LampBlock& lamps;
    const LampShadows& lampShadows;       ///< of planLampShadows
    gpu::Image ggxTable;                  ///< of makeGgxTable
    gpu::BufferView blueNoise;            ///< of blueNoise()
    const TracedScene* traced = nullptr;  ///< for settings that trace rays through the scene (tracesScene)
    double time = 0.0;                    ///< of the scene's animations [s]
    ProbeMaps probes{};                   ///< that rays ask; none: they do not
    vec4 clipPlane{0.0F};                 ///< as of drawGBuffer; zero: none
};

/// Formats where the effects declare them.
struct ViewImages {
    GBuffer g;
    gpu::Image backDepth;         ///< none unless trace_screen.thickness_mode is second_layer
    gpu::Image pyramid;           ///< none unless trace_screen.method is hiz or there are contact shadows
    gpu::Image shadowMap;         ///< none without sun or shadows
    SunShadowParams sun{};        ///< its parts
    gpu::Image rawSunVisibility;  ///< before it was cleaned
    gpu::Image sunVisibility;     ///< that direct light uses
    gpu::Image shadowPenumbra;    ///< of sunVisibility(); none with hard shadows
    gpu::Image cascadeIndex;      ///< of sunVisibility(); none with one cascade
    gpu::Image lampShadowMap;     ///< none where no lamp casts a shadow
    LampTiles lampTiles;          ///< of all lamps
    gpu::Image lampVisibility;    ///< none where no lamp casts a shadow
    gpu::Image direct;
};

/// What rays that are traced through the scene are lit with.
SceneLights sceneLights(const ViewInputs& in, const Settings& settings);

/// Records the passes of one view. Views besides the frame's own go within a viewScope, lest they write over its
/// images. lampShadowMap: of another view of the same frame, which serves all; none: it is drawn.
ViewImages directView(gpu::Frame& f, const ViewInputs& in, const Settings& settings, gpu::Image lampShadowMap = {});

}  // namespace reflet
