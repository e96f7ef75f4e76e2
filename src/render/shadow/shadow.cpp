// Records the sun's shadow map and its look-up.
#include "render/shadow/shadow.h"

#include "render/levels.h"

#include <string>

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

gpu::Image makeShadowRange(gpu::Frame& f, gpu::Image shadowMap) {
    const uvec2 cells = levelSize(shadowMap.size, 2);  // 4 texels each: what level 0 would be
    const gpu::Image range =
        f.image("shadow_range", VK_FORMAT_R32G32_SFLOAT, levelsImageSize(cells, shadowRangeLevels));
    for (uint32_t level = 1; level < shadowRangeLevels; ++level) {
        f.compute("shadow_range." + std::to_string(level), "shadow_range.comp")
            .read("shadowMap", shadowMap)
            .write("range", range)
            .params(ShadowRangeParams{shadowMap.size, level})
            .dispatch(levelSize(cells, level));
    }
    return range;
}

SunVisibility sunVisibility(gpu::Frame& f, const GBuffer& g, const ShadowInputs& in,
                            const ShadowVisibilityParams& params) {
    const ShadowFilter filter = params.settings.filter;
    const bool soft = filter == ShadowFilter::pcf || filter == ShadowFilter::pcss;
    const char* shader = soft ? "soft_visibility.comp" : "shadow_visibility.comp";
    SunVisibility out;
    out.visibility = f.image("sun_visibility", VK_FORMAT_R8_UNORM, g.depth.size);
    gpu::Pass pass = f.compute("shadow_visibility", shader);
    pass.read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("shadowMap", in.map ? in.map : g.depth)  // bound, but not read without shadows
        .write("visibility", out.visibility)
        .params(params);
    if (soft) {
        out.penumbra = f.image("shadow_penumbra", VK_FORMAT_R16G16_SFLOAT, g.depth.size);
        pass.read("range", in.range ? in.range : in.map)
            .read("blueNoise", in.blueNoise)
            .write("penumbra", out.penumbra)
            .constant("searchRanges", in.range ? 1 : 0);
    }
    pass.dispatch(out.visibility.size);
    return out;
}

}  // namespace reflet
