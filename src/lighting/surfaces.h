// What the stages of a view share: its camera, its surfaces, and tables.
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

/// The camera, and what is the same for all surfaces that it sees.
struct ViewContext {
    ViewParams view;
    EnvironmentLight environment;
    gpu::Image ggxTable;        ///< of ggxTable
    gpu::BufferView blueNoise;  ///< noise/blue_noise.h
    CacheBuffers cache{};       ///< for the diffuse lobe; may be none
    bool lambertOnly = false;   ///< every material is Lambert diffuse (MaterialsSettings)
    bool unlit = false;         ///< nothing reflects light: no rays are traced
    bool composes = true;       ///< each frame's light is composited, for the next one's rays to read
    bool emitterLamps =
        false;  ///< lamps stand for what surfaces with materialFlagEmitter emit: diffuse rays leave it out
    float roughestHighlight = 0.0F;  ///< the lamps' highlights stand for their reflections up to this roughness
                                     ///< (shaders/emitter_highlight.glsl); 0: rays find all
    bool reflectedSuns = false;      ///< lamps bring the sun's light by way of smooth mirrors
    bool forProbe = false;           ///< a probe's view: with reflectedSuns, mirrors do not show the sun itself
};

/// Surfaces that a view sees: its G-buffer, and what stages have derived from it.
struct Surfaces {
    GBuffer g;
    gpu::Image backDepth;         ///< second depth layer; none: thickness is assumed
    gpu::Image shownDepth;        ///< with what `g.depth` leaves out, for the picture; none: `g.depth`
    gpu::Image reactive;          ///< share of its history that antialiasing gives up; none: 0
    gpu::Image pyramid;           ///< of depthPyramid
    gpu::Image ambientOcclusion;  ///< of the stage; none: prefiltered light is not occluded
};

/// Hierarchical depth (Hi-Z) of the surfaces, which keep it: it is made by the first stage that marches through it.
gpu::Image depthPyramid(gpu::PassList& f, Surfaces& surfaces);

/// `depth` with the precision of another format, of `view`; itself with reversed_float.
gpu::Image keptDepth(gpu::PassList& f, const ViewParams& view, const DepthSettings& settings, gpu::Image depth);

/// The GGX table, which the caller keeps from frame to frame.
gpu::Image ggxTable(gpu::PassList& f, gpu::KeptImage& own);

/// Ambient occlusion for prefiltered light; none with AoMethod::none. own: its history; none: this frame alone.
gpu::Image ambientOcclusion(gpu::PassList& f, DenoiseStore* own, const ViewContext& in,
                            const LightingSettings& settings, const Surfaces& surfaces);

/// Whether ambient occlusion or rays through the screen read the second depth layer.
bool readsBackDepth(const LightingSettings& settings);

}  // namespace lighting
}  // namespace reflet
