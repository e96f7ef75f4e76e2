// One frame: a lit image from a draw list, a view and lights.
#pragma once

#include "gpu/pass_list.h"
#include "lighting/picture.h"
#include "renderer/background/background.h"
#include "renderer/direct_view.h"
#include "renderer/live/live_picture.h"
#include "renderer/planar_views/render_planar.h"
#include "renderer/settings.h"

#include <span>
#include <vector>

namespace reflet {

/// State that a frame keeps for the next one; one for each image that is rendered over time.
struct FrameStore {
    DirectViewStore direct;
    DenoiseStore ambientOcclusion;
    LobeStore diffuse;
    LobeStore specular;
    gpu::HistoryImage lit{"lit"};  ///< light that rays of the next frame read at hits
    std::vector<PlanarStore> planar;
    std::vector<DirectViewStore> live;
    lighting::AccumulateHistory means;
    TemporalStore temporal;
    TemporalStore blended;
    gpu::HistoryImage exposure{"exposure"};
    lighting::DofHistory lens;
};

struct FrameInputs : ViewInputs {
    std::span<const Mirror> mirrors;  ///< from planMirrors
    std::span<const LiveView> live;   ///< live camera images shown by materials of `draws`
    float lightChange = 0.0F;         ///< from LightChange::update
    FrameBackground background{};
    bool autoExposure = false;           ///< measure the exposure
    float elapsed = 0.0F;                ///< seconds of the scene's time since the last frame, not negative
    uvec2 outputSize{};                  ///< size of the picture; larger than the view's with temporal upscaling
    vec2 jitter{};                       ///< subpixel jitter of `view`, in its pixels
    Lens lens;                           ///< lens of the camera
    std::optional<mat4> cameraBefore{};  ///< as in lighting::blurMotion
};

/// All images of the frame; formats are documented with the effects.
struct FrameImages : ViewImages {
    ViewParams view{};      ///< as used for rendering: with subpixel jitter, if any
    gpu::Image probeAtlas;  ///< as in ProbeMaps; none without probes
    LobeLight diffuse;
    LobeLight specular;
    lighting::Light light;
    gpu::Image unfiltered;  ///< light.lit before temporal antialiasing
    gpu::Image temporal;  ///< size FrameInputs.outputSize, like light.lit then: radiance, history length; none without
                          ///< temporal antialiasing
    gpu::Image coverage;  ///< red: share of the pixel that surfaces cover; light.lit is premultiplied by it. None
                          ///< unless the background is a colour or transparent
    gpu::Image circleOfConfusion;  ///< as in DofImages; none without depth of field
    gpu::Image velocityTiles;      ///< as in MotionBlurImages; none without motion blur
    gpu::Image exposure;           ///< from measureExposure(); none without automatic exposure
    gpu::Image display;            ///< alpha: straight, 1 unless the background is transparent
    bool transparent = false;
};

/// Records all passes of one frame.
FrameImages renderFrame(gpu::PassList& f, FrameStore& own, const FrameInputs& in, const Settings& asked);

}  // namespace reflet
