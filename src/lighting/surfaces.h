// Inputs shared by the stages of a view: camera, surfaces, and tables.
#pragma once

#include "effects/denoise/denoise.h"
#include "effects/environment/environment_light.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/gbuffer/kept_depth.h"
#include "effects/radiance_cache/radiance_cache.h"
#include "effects/view.h"
#include "gpu/pass_list.h"

namespace reflet {

struct LightingSettings;

namespace lighting {

/// The camera, and inputs that are the same for all surfaces that it sees.
struct ViewContext {
    ViewParams view;
    EnvironmentLight environment;
    gpu::Image ggxTable;        ///< from ggxTable()
    gpu::BufferView blueNoise;  ///< noise/blue_noise.h
    CacheBuffers cache{};       ///< for the diffuse lobe; may be none
    bool lambertOnly = false;   ///< every material is Lambert diffuse (MaterialsSettings)
    bool unlit = false;         ///< nothing reflects light: no rays are traced
    bool composes = true;       ///< each frame's light is composited, for the next one's rays to read
    bool emitterLamps =
        false;  ///< lamps replace the emission of surfaces with materialFlagEmitter: diffuse rays ignore it
    float roughestHighlight = 0.0F;  ///< the lamps' highlights replace reflections of emitters up to this roughness
                                     ///< (shaders/emitter_highlight.glsl); 0: rays find all
    bool reflectedSuns = false;      ///< lamps carry sunlight reflected by smooth mirrors
    bool forProbe = false;           ///< a probe's view: with reflectedSuns, mirrors do not show the sun itself
};

/// Surfaces that a view sees: its G-buffer, and images derived from it.
struct Surfaces {
    GBuffer g;
    gpu::Image backDepth;         ///< second depth layer; none: thickness is assumed
    gpu::Image shownDepth;        ///< depth including surfaces that `g.depth` omits, for the picture; none: `g.depth`
    gpu::Image reactive;          ///< reactive mask: share of the history that TAA discards; none: 0
    gpu::Image pyramid;           ///< from depthPyramid()
    gpu::Image ambientOcclusion;  ///< from ambientOcclusion(); none: prefiltered light is not occluded
};

/// Hierarchical depth (Hi-Z) of the surfaces, stored in `surfaces.pyramid`: built by the first stage that marches
/// through it.
gpu::Image depthPyramid(gpu::PassList& f, Surfaces& surfaces);

/// `depth` of `view`, rounded to the precision of the settings' depth format; unchanged with reversed_float.
gpu::Image keptDepth(gpu::PassList& f, const ViewParams& view, const DepthSettings& settings, gpu::Image depth);

/// The GGX directional albedo table, which the caller keeps from frame to frame.
gpu::Image ggxTable(gpu::PassList& f, gpu::KeptImage& own);

/// Ambient occlusion for prefiltered light; none with AoMethod::none. own: its history; none: only this frame.
gpu::Image ambientOcclusion(gpu::PassList& f, DenoiseStore* own, const ViewContext& in,
                            const LightingSettings& settings, const Surfaces& surfaces);

/// Whether ambient occlusion or rays through the screen read the second depth layer.
bool readsBackDepth(const LightingSettings& settings);

}  // namespace lighting
}  // namespace reflet
