// Records the stages of direct light.
#include "lighting/direct.h"

#include "base/error.h"
#include "effects/shadow/shadow_clean.h"
#include "gpu/context.h"

#include <algorithm>

namespace reflet::lighting {

namespace {

// Texels along a side of a cascade's tile.
uint32_t tileSide(const SunMaps& maps) {
    return maps.map.size().x / (maps.sun.count > 1 ? 2U : 1U);
}

// Normals vary by half as much as mirrored directions, and the mean square of a disk's radius is half of its square.
float sunRoughness(float slope) {
    return std::sqrt(std::min(0.5F * std::sqrt(0.5F) * slope, 1.0F));
}

gpu::Image withoutNoise(gpu::PassList& f, gpu::HistoryImage* history, const ViewContext& in,
                        const ShadowSettings& settings, const Surfaces& surfaces, const SunVisibility& seen,
                        const vec3& toSun) {
    if (settings.denoise == 0 || !seen.penumbra) {
        return seen.visibility;
    }
    return denoiseShadow(f, history, surfaces.g, seen.visibility, seen.penumbra,
                         {in.view, toSun, settings.history, settings.samples, 0});
}

}  // namespace

bool keepsPenumbras(const ShadowSettings& settings) {
    const bool soft = settings.filter == ShadowFilter::pcf || settings.filter == ShadowFilter::pcss;
    return soft && settings.denoise != 0 && settings.history > 0;
}

bool readsShadowRange(const ShadowSettings& settings) {
    return settings.filter == ShadowFilter::pcss && settings.earlyOut != 0;
}

uvec2 shadowRangeSize(uvec2 map) {
    return reflet::shadowRangeSize(map);
}

gpu::Image shadowRange(gpu::PassList& f, const ShadowSettings& settings, const ShadowMap& map) {
    if (!readsShadowRange(settings)) {
        return {};
    }
    const gpu::Image range = f.image("shadow_range", shadowRangeFormat, shadowRangeSize(map.size()));
    shadowRange(f, map, range);
    return range;
}

void shadowRange(gpu::PassList& f, const ShadowMap& map, gpu::Image range) {
    makeShadowRange(f, map, range);
}

SunShadow sunShadow(gpu::PassList& f, gpu::HistoryImage* history, const ViewContext& in,
                    const LightingSettings& settings, Surfaces& surfaces, const SunMaps& maps) {
    ShadowSettings shadow = settings.shadow;
    if (maps.map) {
        shadow.resolution = tileSide(maps);
    } else {
        shadow.filter = ShadowFilter::none;
    }
    const gpu::Image range = readsShadowRange(shadow) ? maps.range : gpu::Image{};
    const SunVisibility seen =
        sunVisibility(f, surfaces.g, {.map = maps.map, .range = range, .blueNoise = in.blueNoise},
                      {in.view, maps.sun, shadow, maps.slope});
    SunShadow out{.visibility = withoutNoise(f, history, in, shadow, surfaces, seen, maps.toSun),
                  .raw = seen.visibility,
                  .penumbra = seen.penumbra,
                  .cascadeIndex = seen.cascadeIndex};
    if (maps.contact && settings.contact.distance > 0.0F) {
        out.visibility = contactShadow(f, surfaces.g, depthPyramid(f, surfaces), out.visibility,
                                       {in.view, settings.contact, vec4(maps.toSun, 0.0F)});
    }
    return out;
}

gpu::Image contactVisibility(gpu::PassList& f, const ViewContext& in, const ContactSettings& settings,
                             Surfaces& surfaces, const vec4& light) {
    const gpu::Image lit = f.image("contact_shadow.lit", VK_FORMAT_R8_UNORM, surfaces.g.depth.size);
    f.clear(lit, {{1.0F, 1.0F, 1.0F, 1.0F}});
    return contactShadow(f, surfaces.g, depthPyramid(f, surfaces), lit, {in.view, settings, light});
}

LampTiles lampTiles(gpu::PassList& f, const ViewContext& in, const DirectSettings& settings, const Surfaces& surfaces,
                    const LampBlock& lamps) {
    return findLampTiles(f, surfaces.g.depth, lamps, in.view, settings);
}

gpu::Image lampShadow(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const Surfaces& surfaces, const LampTiles& tiles, const LampShadows& shadows, gpu::Image map) {
    if (shadows.count == 0) {
        return {};
    }
    return lampVisibility(f, surfaces.g, {map, tiles.masks, in.blueNoise}, shadows, {in.view, settings.shadow});
}

gpu::Image lampShadow(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const Surfaces& surfaces, std::span<HostLamp> lamps) {
    LampShadows shadows{};
    LampBlock block{};
    uint32_t tiles = 0;
    for (HostLamp& lamp : lamps) {
        lamp.shadow.index = block.count;
        lamp.shadow.firstTile = tiles;
        tiles += lamp.shadow.tiles;
        shadows.tileSize = std::max(shadows.tileSize, lamp.shadow.side);
        shadows.lamps[shadows.count++] = lamp.shadow;
        block.lamps[block.count++] = lamp.shadow.lamp;
    }
    const uint32_t most = f.context().limits().maxImageDimension2D / std::max(shadows.tileSize, 1U);
    shadows.columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<float>(tiles))));
    if (shadows.columns > most) {
        failUsage("lamps: {} maps of {}x{} texels do not fit into one image of this device; give smaller or fewer maps",
                  tiles, shadows.tileSize, shadows.tileSize);
    }
    const auto scope = f.scope("shadow");
    const gpu::Image atlas = lampAtlas(f, shadows);
    for (const HostLamp& lamp : lamps) {
        ImportLampParams params = lamp.import;
        const LampShadow& s = lamp.shadow;
        params.position = vec4(s.lamp.position, 0.0F);
        const mat3 axes = glm::transpose(s.worldToTile);
        params.tileX = vec4(axes[0], 0.0F);
        params.tileY = vec4(axes[1], 0.0F);
        params.tileZ = vec4(axes[2], 0.0F);
        params.halfTangent = s.halfTangent;
        params.near = s.near;
        params.firstTile = s.firstTile;
        params.faces = s.tiles;
        params.side = s.side;
        params.cell = shadows.tileSize;
        params.columns = shadows.columns;
        importLampMap(f, lamp.map, lamp.isCube, params, atlas);
    }
    return lampShadow(f, in, settings, surfaces, lampTiles(f, in, {}, surfaces, block), shadows, atlas);
}

DirectLight directLight(gpu::PassList& f, const ViewContext& in, const Surfaces& surfaces, const LightSources& lights) {
    return reflet::directLight(
        f, surfaces.g, lights.visibility, in.ggxTable,
        {in.view, lights.toSun, lights.sunIrradiance, sunRoughness(lights.sunSlope), in.roughestHighlight},
        {lights.lamps, in.environment, in.lambertOnly, in.reflectedSuns && in.forProbe});
}

}  // namespace reflet::lighting
