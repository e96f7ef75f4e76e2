// Records one camera's view under direct light.
#include "renderer/direct_view.h"

#include "renderer/draw_gbuffer/back_depth.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/draw_shadows/lamp_shadow_maps.h"
#include "renderer/draw_shadows/shadow_maps.h"
#include "renderer/glass/glass.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

void drawSurfaces(gpu::PassList& f, const ViewInputs& in, const Settings& settings, ViewImages& out) {
    GBufferContent content{.clipPlane = in.clipPlane};
    content.withoutGlass = drawsGlass(in.draws, settings.transmission, settings.materials);
    content.blendedFrom = settings.blend.layers > 0 ? opaqueAlpha : blendCutoff;
    // Probes are filtered before use: their surfaces may be a third of a pixel off, with edges of six.
    content.levelScale = in.forProbe ? 1.0F / 3 : 1.0F;
    out.g = drawGBuffer(f, in.draws, in.view, settings.materials, content);
    out.drawnDepth = out.g.depth;
    if (lighting::readsBackDepth(settings)) {
        const gpu::Image back = drawBackDepth(f, in.draws, out.g.depth, in.view, content.withoutGlass);
        out.backDepth = lighting::keptDepth(f, in.view, settings.depth, back);
    }
    out.g.depth = lighting::keptDepth(f, in.view, settings.depth, out.drawnDepth);
}

bool sunShines(const ViewInputs& in) {
    return in.sunIrradiance != vec3(0.0F);
}

float sunSlope(const ViewInputs& in) {
    return lighting::sunSlope(in.sunAngularDiameter);
}

// Whether sunlight passes through some surfaces, in part.
bool shinesThrough(const ViewInputs& in, const Settings& settings) {
    const bool blended = settings.blend.layers > 0 && std::ranges::any_of(in.draws.draws, &Draw::blended);
    return blended || drawsGlass(in.draws, settings.transmission, settings.materials);
}

/// Of a face of a probe: a map of the whole scene, which all faces share, where it is as fine as the face's own. A face
/// that sees little keeps its own, into which few things are drawn. True if `sun` and `shadow` are those of the former.
bool sharesSunMap(const ViewInputs& in, SunShadowParams& sun, ShadowSettings& shadow, uint32_t resolution) {
    if (!in.forProbe || shadow.extent > 0.0F) {
        return false;
    }
    const ShadowMapParams whole = wholeSunShadow(in.draws.boundsW, in.sunDirection, resolution);
    if (whole.texelSize > sun.maps[0].texelSize) {
        return false;
    }
    sun.maps[0] = whole;
    shadow.resolution = resolution;
    return true;
}

// Four texels for each pixel of a face of a probe: more of them would not be seen.
uint32_t ownResolution(const ViewInputs& in, const ShadowSettings& shadow) {
    return in.forProbe ? std::min(shadow.resolution, 4 * static_cast<uint32_t>(in.view.size.x)) : shadow.resolution;
}

void drawSunMaps(gpu::PassList& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                 ViewImages& out) {
    ShadowSettings shadow = settings.shadow;
    shadow.filter = sunShines(in) ? shadow.filter : ShadowFilter::none;
    const uint32_t sharedResolution = 2 * shadow.resolution;
    shadow.resolution = ownResolution(in, shadow);
    const bool choosesCascades = shadow.filter != ShadowFilter::none && shadow.cascades == 0;
    out.sun = fitSunShadows(in.view, in.draws.boundsW, in.sunDirection, shadow,
                            filterReach(in.draws.boundsW, shadow, sunSlope(in)),
                            choosesCascades ? nearestSurface(in.view, in.draws) : 0.0F);
    if (shadow.filter == ShadowFilter::none) {
        return;
    }
    const bool through = shinesThrough(in, settings);
    gpu::KeptImage& map = sharesSunMap(in, out.sun, shadow, sharedResolution) ? own.sharedShadowMap : own.shadowMap;
    out.shadowMap = drawShadowMap(f, map, in.draws, out.sun, shadow, through);
    if (lighting::readsShadowRange(shadow)) {
        out.shadowRange = drawShadowRange(f, own.shadowRange, out.shadowMap, in.draws, out.sun, shadow, through);
    }
    if (through) {
        out.blendShadow = drawBlendShadowMaps(f, own.blendShadow, in.draws, out.sun, shadow);
    }
}

// Whether rays find the shadows, and there are no maps.
bool tracesShadows(const ViewInputs& in, const Settings& settings) {
    return settings.shadow.filter == ShadowFilter::traced && in.traced != nullptr;
}

DirectRays traceDirectLight(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const GBuffer& g) {
    return directByRays(f, g, {*in.traced, in.ggxTable, in.environment, in.lamps},
                        {in.view, sceneLights(in, settings), settings.shadow.rays});
}

// Sun visibility per pixel: shadow map, denoising, contact shadows, blended surfaces.
void findSunVisibility(gpu::PassList& f, gpu::HistoryImage* history, const ViewInputs& in, const Settings& settings,
                       ViewImages& out) {
    const lighting::SunMaps maps{{out.shadowMap},  out.shadowRange, out.sun,
                                 -in.sunDirection, sunSlope(in),    sunShines(in)};
    const lighting::SunShadow sun = lighting::sunShadow(f, history, contextOf(in, settings), settings, out, maps);
    out.rawSunVisibility = sun.raw;
    out.shadowPenumbra = sun.penumbra;
    out.cascadeIndex = sun.cascadeIndex;
    out.sunVisibility = sun.visibility;
    if (out.blendShadow.front().depth) {
        out.sunVisibility = blendShadow(f, out.g, out.blendShadow, out.sunVisibility,
                                        {in.view, out.sun, settings.shadow.resolution, settings.shadow.bias});
    }
}

}  // namespace

// Probes add the reflections of emitters to what they have captured.
static float roughestHighlight(const ViewInputs& in, const Settings& settings) {
    const SpecularSettings& s = settings.specular;
    const bool cones = s.roughFallback == RoughFallback::mips;
    return anyEmitters(in.lamps) && !in.forProbe && s.rays > 0 ? (cones ? s.maxRoughness : 1.0F) : 0.0F;
}

lighting::ViewContext contextOf(const ViewInputs& in, const Settings& settings) {
    return {.view = in.view,
            .environment = in.environment,
            .ggxTable = in.ggxTable,
            .blueNoise = in.blueNoise,
            .cache = in.cache,
            .lambertOnly = settings.materials.lambertOnly != 0,
            .unlit = in.draws.unlit,
            .emitterLamps = anyEmitters(in.lamps),
            .roughestHighlight = roughestHighlight(in, settings),
            .reflectedSuns = anyReflected(in.lamps),
            .forProbe = in.forProbe};
}

SceneLights sceneLights(const ViewInputs& in, const Settings& settings) {
    return {.toSun = -in.sunDirection,
            .sunSine = std::sin(0.5F * in.sunAngularDiameter),
            .sunIrradiance = in.sunIrradiance,
            .allLampsCast = settings.shadow.filter == ShadowFilter::traced ? 1U : 0U,
            .lambertOnly = settings.materials.lambertOnly};
}

ViewImages directView(gpu::PassList& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                      gpu::Image lampShadowMap, ViewHistory history) {
    ViewImages out;
    out.lampShadowMap = lampShadowMap;
    drawSurfaces(f, in, settings, out);
    if (!tracesShadows(in, settings)) {
        drawSunMaps(f, own, in, settings, out);
        if (in.lampShadows.count > 0 && !lampShadowMap) {
            out.lampShadowMap = drawLampShadowMap(f, own.lampShadowMap, in.draws, in.lampShadows);
        }
    }
    lightSurfaces(f, history == ViewHistory::kept ? &own.sunVisibility : nullptr, in, settings, out);
    return out;
}

void lightSurfaces(gpu::PassList& f, gpu::HistoryImage* history, const ViewInputs& in, const Settings& settings,
                   ViewImages& out) {
    if (tracesShadows(in, settings)) {
        const DirectRays rays = traceDirectLight(f, in, settings, out.g);
        out.direct = rays.direct;
        out.sunVisibility = rays.sunVisibility;
        out.rawSunVisibility = rays.sunVisibility;
        return;
    }
    const lighting::ViewContext context = contextOf(in, settings);
    findSunVisibility(f, history, in, settings, out);
    out.lampTiles = lighting::lampTiles(f, context, settings.direct, out, in.lamps);
    out.lampVisibility =
        lighting::lampShadow(f, context, settings, out, out.lampTiles, in.lampShadows, out.lampShadowMap);
    const DirectLight light = directLightOn(f, in, settings, out);
    out.direct = light.all;
    out.fromEmitters = light.fromEmitters;
    out.highlights = light.highlights;
}

DirectLight directLightOn(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const ViewImages& images) {
    if (tracesShadows(in, settings)) {
        return {traceDirectLight(f, in, settings, images.g).direct, {}};
    }
    return lighting::directLight(f, contextOf(in, settings), images,
                                 {-in.sunDirection,
                                  in.sunIrradiance,
                                  sunSlope(in),
                                  in.lamps,
                                  {images.sunVisibility, images.lampVisibility, images.lampTiles.masks}});
}

}  // namespace reflet
