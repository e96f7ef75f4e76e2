// Records live camera images.
#include "renderer/live/live_cameras.h"

#include "renderer/sub_views.h"

#include <algorithm>
#include <string>

namespace reflet {

gpu::Image renderLiveCameras(gpu::PassList& f, std::vector<DirectViewStore>& own, const ViewInputs& in,
                             const Settings& settings, std::span<const LiveView> pictures) {
    own.resize(std::max(own.size(), pictures.size()));
    gpu::Image lampShadowMap;
    for (size_t i = 0; i < pictures.size(); ++i) {
        const auto scope = f.scope("live" + std::to_string(i));
        ViewInputs view = in;
        view.view = pictures[i].view;
        const ViewImages seen = directView(f, own[i], view, liveSettings(settings), lampShadowMap);
        lampShadowMap = seen.lampShadowMap;
        showLive(f, seen.direct, pictures[i].picture);
    }
    return lampShadowMap;
}

}  // namespace reflet
