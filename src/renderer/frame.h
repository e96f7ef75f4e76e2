// One frame: a lit image from a draw list, a view and lights.
#pragma once

#include "effects/accumulate/accumulate.h"
#include "effects/composite/composite.h"
#include "effects/depth_of_field/depth_of_field.h"
#include "effects/lobe/rays.h"
#include "effects/temporal/temporal.h"
#include "gpu/recorder.h"
#include "renderer/background/background.h"
#include "renderer/blend/blend_layers.h"
#include "renderer/coat/coat.h"
#include "renderer/direct_view.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/glass/glass_layers.h"
#include "renderer/lit_layer.h"
#include "renderer/planar/mirrors.h"
#include "renderer/settings.h"
#include "renderer/trace_lobe.h"

#include <memory>
#include <vector>

namespace reflet {

/// What a frame keeps for the next one; every picture that is rendered over time has its own.
struct FrameStore {
    struct Planar {
        DirectViewStore direct;
        std::unique_ptr<MirroredScene> room;  ///< drawn in this frame, if any
    };
    DirectViewStore direct;
    LobeStore diffuse;
    LobeStore specular;
    gpu::HistoryImage history{"lit"};
    std::vector<Planar> planar;
    std::vector<DirectViewStore> live;
    AccumulateStore coverageMean;
    AccumulateStore accumulated;
    TemporalStore temporal;
    gpu::HistoryImage exposure{"exposure"};
    gpu::HistoryImage circleOfConfusion{"circle_of_confusion"};
    gpu::HistoryImage coverageCircleOfConfusion{"coverage.circle_of_confusion"};
};

struct FrameInputs : ViewInputs {
    std::span<const Mirror> mirrors;  ///< from planMirrors
    std::span<const LiveView> live;   ///< live camera images shown by materials of `draws`
    uint32_t framesBefore = 0;        ///< this one with the same view, lights and settings
    FrameBackground background{};
    bool autoExposure = false;  ///< measure the exposure
    float elapsed = 0.0F;       ///< seconds of the scene's time since the last frame, not negative
    uvec2 outputSize{};         ///< of the picture; larger than the view's size with temporal upscaling
    vec2 jitter{};              ///< of `view`, in its pixels
    Lens lens;                  ///< of the camera
};

/// All images of the frame; formats are documented with the effects.
struct FrameImages : ViewImages {
    ViewParams view{};      ///< as used for rendering: with subpixel jitter, if any
    gpu::Image probeAtlas;  ///< of ProbeMaps; none without probes
    LobeLight diffuse;
    LobeLight specular;
    Composite light;
    gpu::Image unfiltered;  ///< light.lit before temporal antialiasing
    gpu::Image temporal;    ///< of FrameInputs.outputSize, as light.lit then is: radiance, history length; none without
                            ///< temporal antialiasing
    gpu::Image coverage;    ///< red: share of the pixel that surfaces cover; light.lit is premultiplied by it. None
                            ///< unless the background is a colour or transparent
    gpu::Image circleOfConfusion;  ///< of DofImages; none without depth of field
    gpu::Image exposure;           ///< of measureExposure; none without automatic exposure
    gpu::Image display;            ///< alpha: straight, 1 unless the background is transparent
    bool transparent = false;
};

/// Records all passes of one frame.
FrameImages renderFrame(gpu::Recorder& f, FrameStore& own, const FrameInputs& in, const Settings& asked);

}  // namespace reflet
