// One frame: a lit image from a draw list, a view and lights.
#pragma once

#include "gpu/recorder.h"
#include "render/background/background.h"
#include "render/bounce/rays.h"
#include "render/composite/composite.h"
#include "render/direct_view.h"
#include "render/planar/mirrors.h"
#include "render/settings.h"

namespace reflet {

struct FrameInputs : ViewInputs {
    std::span<const Mirror> mirrors;  ///< from planMirrors
    std::span<const LiveView> live;   ///< live camera images shown by materials of `draws`
    uint32_t framesBefore = 0;        ///< this one with the same view, lights and settings
    FrameBackground background{};
    bool autoExposure = false;  ///< measure the exposure
    float elapsed = 0.0F;       ///< seconds of the scene's time since the last frame, not negative
};

/// All images of the frame; formats are documented with the effects.
struct FrameImages : ViewImages {
    ViewParams view{};      ///< as used for rendering: with subpixel jitter, if any
    gpu::Image probeAtlas;  ///< of ProbeMaps; none without probes
    LobeLight diffuse;
    LobeLight specular;
    Composite light;
    gpu::Image unfiltered;  ///< light.lit before temporal antialiasing
    gpu::Image temporal;    ///< radiance, history length; none without temporal antialiasing
    gpu::Image coverage;    ///< red: share of the pixel that surfaces cover; light.lit is premultiplied by it. None
                            ///< unless the background is a colour or transparent
    gpu::Image exposure;    ///< of measureExposure; none without automatic exposure
    gpu::Image display;     ///< alpha: straight, 1 unless the background is transparent
    bool transparent = false;
};

/// Records all passes of one frame.
FrameImages renderFrame(gpu::Recorder& f, const FrameInputs& in, const Settings& settings);

}  // namespace reflet
