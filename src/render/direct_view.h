// What one camera sees under direct light: G-buffer, visibility of sun and lamps, radiance. The first half of the
// frame, for its camera and for views besides (mirrored ones, the faces of probes).
#pragma once

#include "gpu/frame.h"
#include "render/direct/direct.h"
#include "render/draw_list.h"
#include "render/gbuffer/gbuffer.h"
#include "render/settings.h"
#include "render/shadow/lamp_shadow.h"

namespace reflet {

struct ViewInputs {
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
    vec4 clipPlane{0.0F};            ///< as of drawGBuffer; zero: none
};

/// Formats where the effects declare them.
struct ViewImages {
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
    gpu::Image direct;
};

/// Records the passes of one view. Views besides the frame's own go within a viewScope, lest they write over its
/// images. lampShadowMap: of another view of the same frame, which serves all; none: it is drawn.
ViewImages directView(gpu::Frame& f, const ViewInputs& in, const Settings& settings, gpu::Image lampShadowMap = {});

}  // namespace reflet
