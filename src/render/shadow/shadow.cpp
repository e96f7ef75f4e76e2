// Records the sun's shadow maps and their look-up.
#include "render/shadow/shadow.h"

#include "gpu/device.h"

namespace reflet {

namespace {

// The part of the target that a cascade's draws go to.
void setTile(const gpu::DrawCommands& to, uint cascade, uint resolution) {
    const VkRect2D tile{
        {static_cast<int32_t>(cascade % 2 * resolution), static_cast<int32_t>(cascade / 2 * resolution)},
        {resolution, resolution}};
    const VkViewport viewport{static_cast<float>(tile.offset.x),
                              static_cast<float>(tile.offset.y),
                              static_cast<float>(resolution),
                              static_cast<float>(resolution),
                              0,
                              1};
    to.device.vk.vkCmdSetViewport(to.commands, 0, 1, &viewport);
    to.device.vk.vkCmdSetScissor(to.commands, 0, 1, &tile);
}

}  // namespace

gpu::Image drawShadowMap(gpu::Frame& f, const DrawList& list, const SunShadowParams& sun,
                         const ShadowSettings& settings) {
    const uvec2 tiles(sun.count > 1 ? 2 : 1, sun.count > 2 ? 2 : 1);
    const gpu::Image depth = f.target("shadow_map", VK_FORMAT_D32_SFLOAT, tiles * settings.resolution);
    const auto record = [&](const gpu::DrawCommands& to, bool masked) {
        for (uint i = 0; i < sun.count; ++i) {
            setTile(to, i, settings.resolution);
            recordDraws(to, list,
                        {.keep = [masked](const Draw& d) { return d.masked == masked; },
                         .cull = Cull::none,
                         .bindMaterials = masked,
                         .worldToClip = sun.maps[i].worldToShadow,
                         .instance = i},
                        false);
        }
    };
    // Opaque draws need no fragment shader; cut-out ones look up their alpha.
    f.raster("shadow_map", {"shadow_map.vert"})
        .depth(depth, 0.0F)
        .vertices(vertexLayout())
        .params(sun)
        .draw([&](const gpu::DrawCommands& to) { record(to, false); });
    f.raster("shadow_map", {"shadow_map_masked.vert", "shadow_map_masked.frag"})
        .depth(depth, std::nullopt)
        .vertices(vertexLayout(), list.materialLayout)
        .params(sun)
        .draw([&](const gpu::DrawCommands& to) { record(to, true); });
    return depth;
}

SunVisibility sunVisibility(gpu::Frame& f, const GBuffer& g, gpu::Image shadowMap,
                            const ShadowVisibilityParams& params) {
    const bool cascades = params.sun.count > 1;
    const gpu::Image index =
        f.image("cascade_index", VK_FORMAT_R8_UNORM, cascades ? g.depth.size : uvec2(1));  // bound in any case
    SunVisibility out;
    out.visibility = f.image("sun_visibility", VK_FORMAT_R8_UNORM, g.depth.size);
    out.cascadeIndex = cascades ? index : gpu::Image{};
    f.compute("shadow_visibility", "shadow_visibility.comp")
        .read("depth", g.depth)
        .read("geometricNormal", g.geometricNormal)
        .read("shadowMap", shadowMap ? shadowMap : g.depth)  // bound, but not read without shadows
        .write("visibility", out.visibility)
        .write("cascadeIndex", index)
        .params(params)
        .dispatch(out.visibility.size);
    return out;
}

}  // namespace reflet
