// One camera's view under direct light: G-buffer, visibility of sun and lamps, radiance. The first half of the frame,
// also used for planar views, live cameras and probe faces.
#pragma once

#include "effects/probe/probes.h"
#include "gpu/pass_list.h"
#include "lighting/direct.h"
#include "lighting/surfaces.h"
#include "renderer/blend/blend_shadow.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/draw_list.h"
#include "renderer/glass/camera_medium.h"
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
    EnvironmentLight environment;     ///< from EnvironmentMaps::update
    const LampBlock& lamps;
    const LampShadows& lampShadows;        ///< from planLampShadows
    gpu::Image ggxTable;                   ///< from ggxTable()
    gpu::BufferView blueNoise;             ///< from blueNoise()
    const TracedScene* traced = nullptr;   ///< BVH; only if the settings trace the scene (tracesScene)
    double time = 0.0;                     ///< time of the scene's animations [s]
    ProbeMaps probes{};                    ///< probes for rays; may be empty
    CacheBuffers cache{};                  ///< radiance cache; may be none
    vec4 clipPlane{0.0F};                  ///< as for drawGBuffer; zero: none
    bool forProbe = false;                 ///< as in ViewContext
    std::optional<CameraMedium> medium{};  ///< from cameraMedium; only for the camera itself, not for sub-views
};

/// View parameters and lights, as the lighting stages read them.
lighting::ViewContext contextOf(const ViewInputs& in, const Settings& settings);

/// Formats are documented with the effects.
struct ViewImages : lighting::Surfaces {
    gpu::Image drawnDepth;        ///< depth of `g` before depth.format, D32
    gpu::Image shadowMap;         ///< none without sun or shadows
    gpu::Image shadowRange;       ///< min/max pyramid of shadowMap; none unless it is used
    SunShadowParams sun{};        ///< cascades of shadowMap
    BlendShadowMaps blendShadow;  ///< none without sun, shadows or blended surfaces
    gpu::Image rawSunVisibility;  ///< before denoising
    gpu::Image sunVisibility;     ///< as used by direct light
    gpu::Image shadowPenumbra;    ///< from sunVisibility(); none with hard shadows
    gpu::Image cascadeIndex;      ///< from sunVisibility(); none with one cascade
    gpu::Image lampShadowMap;     ///< none if no lamp casts a shadow
    LampTiles lampTiles;          ///< of all lamps
    gpu::Image lampVisibility;    ///< none if no lamp casts a shadow
    gpu::Image direct;
    gpu::Image fromEmitters;  ///< as in DirectLight
    gpu::Image highlights;    ///< as in DirectLight
};

/// Lights for shading at hits of traced rays.
SceneLights sceneLights(const ViewInputs& in, const Settings& settings);

/// State of a view that is kept for the next frame: shadow maps while they are valid, and the history of the sun's
/// visibility.
struct DirectViewStore {
    gpu::KeptImage shadowMap{"shadow_map"};
    gpu::KeptImage sharedShadowMap{"shared_shadow_map"};  ///< covers the whole scene, for faces of probes
    gpu::KeptImage shadowRange{"shadow_range"};
    BlendShadowStore blendShadow;
    gpu::KeptImage lampShadowMap{"lamp_shadow_map"};
    gpu::HistoryImage sunVisibility{"shadow_clean.history"};
};

/// Whether the history of the last frame belongs to this view.
enum class ViewHistory : uint8_t { kept, none };

/// Records the passes of one view. lampShadowMap: of another view of this frame, to be shared; none: renders its own.
ViewImages directView(gpu::PassList& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                      gpu::Image lampShadowMap = {}, ViewHistory history = ViewHistory::kept);

/// Computes visibility and direct light for other surfaces of a view (a translucent layer) with the view's shadow maps,
/// and sets these images of `out`. history: of the denoised sun visibility; may be null.
void lightSurfaces(gpu::PassList& f, gpu::HistoryImage* history, const ViewInputs& in, const Settings& settings,
                   ViewImages& out);

/// Direct light at surfaces whose shadow visibility is the one in `images`.
DirectLight directLightOn(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const ViewImages& images);

}  // namespace reflet
