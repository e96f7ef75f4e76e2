// Records the sun's shadow map and its look-up.
#include "render/shadow/shadow.h"

namespace reflet {

gpu::Image drawShadowMap(gpu::Frame& f, const DrawList& list, const ShadowMapParams& map,
                         const ShadowSettings& settings) {
    const gpu::Image depth = f.target("shadow_map", VK_FORMAT_D32_SFLOAT, uvec2(settings.resolution));
    // Opaque draws need no fragment shader; cut-out ones look up their alpha.
    f.raster("shadow_map", {"shadow_map.vert"})
        .depth(depth, 0.0F)
        .vertices(vertexLayout())
        .params(map.worldToShadow)
        .draw([&](const gpu::DrawCommands& to) {
            recordDraws(to, list, {[](const Draw& d) { return !d.masked; }, Cull::none, false, map.worldToShadow},
                        false);
        });
    f.raster("shadow_map", {"shadow_map_masked.vert", "shadow_map_masked.frag"})
        .depth(depth, std::nullopt)
        .vertices(vertexLayout(), list.materialLayout)
        .params(map.worldToShadow)
        .draw([&](const gpu::DrawCommands& to) {
            recordDraws(to, list, {[](const Draw& d) { return d.masked; }, Cull::none, true, map.worldToShadow}, false);
        });
    return depth;
}

gpu::Image sunVisibility(gpu::Frame& f, const GBuffer& g, gpu::Image shadowMap, const ShadowMapParams& map,
                         const ViewParams& view, const ShadowSettings& settings) {
    const gpu::Image visibility = f.image("sun_visibility", VK_FORMAT_R8_UNORM, g.depth.size);
    f.compute("shadow_visibility", "shadow_visibility.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("shadowMap", shadowMap ? shadowMap : g.depth)  // bound, but not read without shadows
        .write("visibility", visibility)
        .params(ShadowVisibilityParams{view, map, settings})
        .dispatch(visibility.size);
    return visibility;
}

}  // namespace reflet
