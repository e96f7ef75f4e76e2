// Draws the second depth layer.
#include "renderer/gbuffer/back_depth.h"

namespace reflet {

gpu::Image drawBackDepth(gpu::Recorder& f, gpu::KeptImage& own, const DrawList& list, gpu::Image depth,
                         const ViewParams& view, bool withoutGlass) {
    const gpu::Image back = own.target(f, VK_FORMAT_D32_SFLOAT, depth.size);
    f.raster("back_depth", {"back_depth.vert", "back_depth.frag"})
        .read("firstDepth", depth)
        .depth(back, 0.0F)
        .vertices(vertexLayout(), list.materialLayout)
        .params(BackDepthParams{view.worldToClip, view.depthToDistance})
        .draw([&](const gpu::DrawCommands& to) {
            const auto keep = [&](const Draw& d) { return !d.blended && !(withoutGlass && d.glass); };
            recordDraws(to, list, {keep, Cull::front, true, view.worldToClip}, false);
        });
    return back;
}

}  // namespace reflet
