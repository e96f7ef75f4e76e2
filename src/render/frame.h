// The frame: a lit picture from a draw list, a view and lights.
#pragma once

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/composite/composite.h"
#include "render/direct/direct.h"
#include "render/direct/lamp_tiles.h"
#include "render/draw_list.h"
#include "render/gbuffer/gbuffer.h"
#include "render/settings.h"
#include "render/shadow/lamp_shadow.h"

namespace reflet {

struct FrameInputs {
    const DrawList& draws;
    ViewParams view;
    vec3 sunDirection{0, -1, 0};      ///< the way the light travels, unit
    vec3 sunIrradiance{0.0F};         ///< on a surface that faces the sun [W/m²]; 0: no sun
    float sunAngularDiameter = 0.0F;  ///< radians
    vec3 environment{0.0F};           ///< radiance from all directions [W/(m² sr)]
    const LampBlock& lamps;
    const LampShadows& lampShadows;  ///< of planLampShadows
    gpu::Image ggxTable;             ///< of makeGgxTable
    gpu::BufferView blueNoise;       ///< of blueNoise()
};

/// Every image of the frame; formats where the effects declare them.
struct FrameImages {
    GBuffer g;
    gpu::Image backDepth;         ///< none unless trace_screen.thicknessFrom is secondLayer
    gpu::Image pyramid;           ///< none unless trace_screen.method is hiz or there are contact shadows
    gpu::Image shadowMap;         ///< none without sun or shadows
    gpu::Image rawSunVisibility;  ///< before it was cleaned
    gpu::Image sunVisibility;     ///< that direct light uses
    gpu::Image shadowPenumbra;    ///< of sunVisibility(); none with hard shadows
    gpu::Image cascadeIndex;      ///< of sunVisibility(); none with one cascade
    gpu::Image lampShadowMap;     ///< none where no lamp casts a shadow
    gpu::Image lampVisibility;    ///< alike
    LampTiles lampTiles;          ///< none without lamps or direct.lampTiles
    gpu::Image direct;
    LobeLight diffuse;
    LobeLight specular;
    Composite light;
    gpu::Image display;
};

/// Records all passes of one frame.
FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings);

}  // namespace reflet
