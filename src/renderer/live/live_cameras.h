// Renders the live camera images that materials show.
#pragma once

#include "renderer/direct_view.h"
#include "renderer/live/live_picture.h"

#include <span>
#include <vector>

namespace reflet {

/// Direct light as each camera sees it. Returns the lamps' shadow map if one was drawn.
gpu::Image renderLiveCameras(gpu::PassList& f, std::vector<DirectViewStore>& own, const ViewInputs& in,
                             const Settings& settings, std::span<const LiveView> pictures);

}  // namespace reflet
