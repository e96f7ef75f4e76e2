// Renders planar reflections: for each mirror of a frame, the view that reflection rays from it read.
#pragma once

#include "renderer/direct_view.h"
#include "renderer/planar_views/mirrors.h"
#include "renderer/planar_views/planar_view.h"
#include "renderer/trace_lobe.h"

#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// State of one mirror's view that is kept for the next frame.
struct PlanarStore {
    DirectViewStore direct;
    std::unique_ptr<MirroredScene> room;  ///< mirrored scene that the frame draws; only for form duplicate
};

/// Renders a view for each mirror. lampShadowMap: of the frame; may be none.
std::vector<PlanarView> renderPlanarViews(gpu::PassList& f, std::vector<PlanarStore>& own, const ViewInputs& in,
                                          const Settings& settings, std::span<const Mirror> mirrors,
                                          gpu::Image lampShadowMap);

}  // namespace reflet
