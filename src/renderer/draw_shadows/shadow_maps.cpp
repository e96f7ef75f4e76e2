// Records the sun's shadow maps.
#include "renderer/draw_shadows/shadow_maps.h"

#include "lighting/direct.h"

namespace reflet {

namespace {

// Everything that a map and its min/max pyramid depend on, as a cache key.
struct SunMapContents {
    uint64_t draws;
    SunShadowParams sun;
    uint16_t resolution;
    uint16_t opaqueOnly;
};
static_assert(sizeof(SunMapContents) == sizeof(SunShadowParams) + 12, "padding would differ at random");

}  // namespace

bool holdsSunMap(gpu::PassList& f, gpu::KeptImage& image, const DrawList& list, const SunShadowParams& sun,
                 const ShadowSettings& settings, bool opaqueOnly) {
    return list.version != 0 && image.holds(f, SunMapContents{.draws = list.version,
                                                              .sun = sun,
                                                              .resolution = uint16_t(settings.resolution),
                                                              .opaqueOnly = uint16_t(opaqueOnly ? 1 : 0)});
}

uvec2 sunMapSize(const SunShadowParams& sun, const ShadowSettings& settings) {
    return uvec2(sun.count > 1 ? 2 : 1, sun.count > 2 ? 2 : 1) * settings.resolution;
}

void recordSunMap(const gpu::DrawCommands& to, const DrawList& list, const SunShadowParams& sun, uint32_t resolution,
                  const std::function<bool(const Draw&)>& keep, bool bindMaterials) {
    for (uint i = 0; i < sun.count; ++i) {
        drawIntoTile(to, uvec2(i % 2, i / 2), resolution);
        recordDraws(to, list,
                    {.keep = keep,
                     .cull = Cull::none,
                     .bindMaterials = bindMaterials,
                     .worldToClip = sun.maps[i].worldToShadow,
                     .pixels = vec2(static_cast<float>(resolution)),
                     .instance = i},
                    false);
    }
}

gpu::Image drawShadowMap(gpu::PassList& f, gpu::KeptImage& own, const DrawList& list, const SunShadowParams& sun,
                         const ShadowSettings& settings, bool opaqueOnly) {
    const gpu::Image depth = own.target(f, VK_FORMAT_D32_SFLOAT, sunMapSize(sun, settings));
    if (holdsSunMap(f, own, list, sun, settings, opaqueOnly)) {
        return depth;
    }
    const auto record = [=, &list](bool masked) {
        return [=, &list](const gpu::DrawCommands& to) {
            const auto keep = [&](const Draw& d) { return d.masked == masked && !(opaqueOnly && d.glass); };
            recordSunMap(to, list, sun, settings.resolution, keep, masked);
        };
    };
    // Opaque draws need no fragment shader; cut-out draws test alpha.
    f.raster("shadow_map", {"shadow_map.vert"})
        .depth(depth, 0.0F)
        .vertices(vertexLayout())
        .params(sun)
        .draw(record(false));
    f.raster("shadow_map", {"shadow_map_masked.vert", "shadow_map_masked.frag"})
        .depth(depth, std::nullopt)
        .vertices(vertexLayout(), list.materialLayout)
        .params(sun)
        .constant("opaqueOnly", opaqueOnly ? 1U : 0U)
        .draw(record(true));
    return depth;
}

gpu::Image drawShadowRange(gpu::PassList& f, gpu::KeptImage& own, gpu::Image shadowMap, const DrawList& list,
                           const SunShadowParams& sun, const ShadowSettings& settings, bool opaqueOnly) {
    const gpu::Image range = own.storage(f, lighting::shadowRangeFormat, lighting::shadowRangeSize(shadowMap.size));
    if (!holdsSunMap(f, own, list, sun, settings, opaqueOnly)) {
        lighting::shadowRange(f, ShadowMap{shadowMap}, range);
    }
    return range;
}

}  // namespace reflet
