// Draws the second depth layer.
#include "renderer/draw_gbuffer/back_depth.h"

namespace reflet {

gpu::Image drawBackDepth(gpu::PassList& f, const DrawList& list, gpu::Image depth, const ViewParams& view,
                         bool withoutGlass) {
    const gpu::Image back = f.target("back_depth", VK_FORMAT_D32_SFLOAT, depth.size);
    f.raster("back_depth", {"back_depth.vert", "back_depth.frag"})
        .read("firstDepth", depth)
        .depth(back, 0.0F)
        .vertices(vertexLayout(), list.materialLayout)
        .params(BackDepthParams{view.worldToClip, view.depthToDistance})
        .draw([&list, withoutGlass, worldToClip = view.worldToClip,
               pixels = vec2(view.size)](const gpu::DrawCommands& to) {
            const auto keep = [&](const Draw& d) { return !d.blended && !(withoutGlass && d.glass); };
            recordDraws(to, list, {keep, Cull::front, true, worldToClip, pixels}, false);
        });
    return back;
}

}  // namespace reflet
