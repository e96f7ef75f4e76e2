// The sources of both lobes of indirect light, for every view and layer of a frame.
#pragma once

#include "effects/lobe/lobe.h"
#include "renderer/direct_view.h"
#include "renderer/planar/mirrors.h"
#include "renderer/planar/planar_view.h"
#include "renderer/settings.h"

#include <vector>

namespace reflet {

/// Surfaces that rays start from, and the views that these are traced in.
struct TracedView {
    ViewImages images;  ///< of the screen itself, or a layer of blended surfaces in front of it
    ScreenImages screen;
    std::vector<PlanarView> mirrors;
};

/// A lobe with the sources that the settings ask for: screen, planar views, the scene's triangles, probes, environment.
LobeLight traceLobe(gpu::Recorder& f, LobeStore* own, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe);

/// Has the same sources answer other rays that start in front of the screen: the screen first, no planar views.
void answerRays(gpu::Recorder& f, Rays& rays, const ViewInputs& in, const Settings& settings, const TracedView& seen);

}  // namespace reflet
