// The sources of both lobes of indirect light, for every view and layer of a frame.
#pragma once

#include "lighting/indirect.h"
#include "renderer/direct_view.h"
#include "renderer/settings.h"

#include <vector>

namespace reflet {

/// Surfaces that rays start from, and the views that the rays are traced in.
struct TracedView {
    ViewImages images;  ///< of the screen itself, or a layer of translucent surfaces in front of it
    ScreenImages screen;
    std::vector<PlanarView> mirrors;
};

/// A view whose screen has direct light as its light. lit: this and the last frame's image of all light; may be none.
TracedView tracedView(gpu::PassList& f, const ViewInputs& in, const Settings& settings, ViewImages images,
                      const gpu::History& lit = {});

/// Traces a lobe against the sources that the settings enable: screen, planar reflections, BVH, probes,
/// environment. history: of the denoiser; null: only this frame.
LobeLight traceLobe(gpu::PassList& f, LobeStore* history, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe);

/// Traces other rays, which start in front of the visible surfaces, against the same sources: the screen first, without
/// planar reflections.
void answerRays(gpu::PassList& f, Rays& rays, const ViewInputs& in, const Settings& settings, const TracedView& seen);

/// Whether rays of the view read its screen's light at hits.
bool readsScreenLight(const ViewInputs& in, const Settings& settings, const TracedView& seen);

}  // namespace reflet
