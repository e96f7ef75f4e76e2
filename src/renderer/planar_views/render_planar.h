// Renders planar reflections: for each mirror of a frame, what reflection rays that start on it see in it.
#pragma once

#include "renderer/direct_view.h"
#include "renderer/planar_views/mirrors.h"
#include "renderer/planar_views/planar_view.h"
#include "renderer/trace_lobe.h"

#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// What the view of one mirror keeps for the next frame.
struct PlanarStore {
    DirectViewStore direct;
    std::unique_ptr<MirroredScene> room;  ///< that the frame draws; none but for form duplicate
};

/// A view for each mirror. lampShadowMap: of the frame; may be none.
std::vector<PlanarView> renderPlanarViews(gpu::PassList& f, std::vector<PlanarStore>& own, const ViewInputs& in,
                                          const Settings& settings, std::span<const Mirror> mirrors,
                                          gpu::Image lampShadowMap);

}  // namespace reflet
