// The frame: a lit picture from a draw list, a view and lights.
#pragma once

#include "gpu/frame.h"
#include "render/bounce/rays.h"
#include "render/composite/composite.h"
#include "render/direct_view.h"
#include "render/planar/mirrors.h"
#include "render/settings.h"

namespace reflet {

struct FrameInputs : ViewInputs {
    std::span<const Mirror> mirrors;  ///< of planMirrors
    std::span<const LiveView> live;   ///< pictures that the materials of `draws` show
    uint32_t framesBefore = 0;        ///< this one, in which view, light and settings have been the same
};

/// Every image of the frame; formats where the effects declare them.
struct FrameImages : ViewImages {
    ViewParams view{};      ///< that it was drawn with: through a place in the pixel, with temporal antialiasing
    gpu::Image probeAtlas;  ///< of ProbeMaps; none without probes
    LobeLight diffuse;
    LobeLight specular;
    Composite light;
    gpu::Image unfiltered;  ///< light.lit before temporal antialiasing
    gpu::Image temporal;    ///< radiance, number of frames; none without temporal antialiasing
    gpu::Image display;
};

/// Records all passes of one frame.
FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings);

}  // namespace reflet
