// Records the shadows of blended surfaces.
#include "renderer/blend/blend_shadow.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <string>

namespace reflet {

BlendShadowMaps drawBlendShadowMaps(gpu::PassList& f, BlendShadowStore& own, const DrawList& list,
                                    const SunShadowParams& sun, const ShadowSettings& settings) {
    const uvec2 size = sunMapSize(sun, settings);
    const VkClearColorValue all{{1, 1, 1, 1}};
    const VkClearColorValue none{};
    BlendShadowMaps maps;
    for (uint32_t layer = 0; layer < blendShadowLayers; ++layer) {
        const std::string name = "blend_shadow_map." + std::to_string(layer);
        BlendShadowMap& map = maps.at(layer);
        BlendShadowStore::Layer& store = own.layers.at(layer);
        map = {store.depth.target(f, VK_FORMAT_D32_SFLOAT, size),
               store.transmittance.target(f, VK_FORMAT_R16G16B16A16_SFLOAT, size),
               store.extinction.target(f, VK_FORMAT_R16G16B16A16_SFLOAT, size)};
        if (holdsSunMap(f, store.depth, list, sun, settings)) {
            continue;
        }
        f.raster(name, {"shadow_map_masked.vert", "blend_shadow_map.frag"})
            .read("nearerDepth", layer > 0 ? maps.front().depth : f.placeholder(VK_FORMAT_R32_SFLOAT))
            .constant("peeled", layer)
            .constant("usedSlots", list.textureSlots)
            .color("transmittance", map.transmittance, all)
            .color("extinction", map.extinction, none)
            .depth(map.depth, 0.0F)
            .vertices(vertexLayout(), list.materialLayout)
            .params(sun)
            .draw([&list, sun, resolution = settings.resolution](const gpu::DrawCommands& to) {
                recordSunMap(to, list, sun, resolution, [](const Draw& d) { return d.blended || d.glass; });
            });
    }
    return maps;
}

gpu::Image blendShadow(gpu::PassList& f, const GBuffer& g, const BlendShadowMaps& maps, gpu::Image sunVisibility,
                       const BlendShadowParams& params) {
    const gpu::Image visibility = f.image("blend_visibility", VK_FORMAT_R8G8B8A8_UNORM, g.depth.size);
    f.compute("blend_shadow", "blend_shadow.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("sunVisibility", sunVisibility)
        .read("depth0", maps[0].depth)
        .read("depth1", maps[1].depth)
        .read("transmittance0", maps[0].transmittance)
        .read("transmittance1", maps[1].transmittance)
        .read("extinction0", maps[0].extinction)
        .write("visibility", visibility)
        .constant("cascades", params.sun.count)
        .params(params)
        .dispatch(visibility.size);
    return visibility;
}

}  // namespace reflet
