// Records one camera's view under direct light.
#include "renderer/direct_view.h"

#include "effects/contact/contact.h"
#include "effects/pyramid/pyramid.h"
#include "renderer/gbuffer/back_depth.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/glass/glass.h"
#include "renderer/shadow/lamp_shadow_maps.h"
#include "renderer/shadow/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

void drawSurfaces(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, ViewImages& out) {
    GBufferContent content{.clipPlane = in.clipPlane};
    content.withoutGlass = drawsGlass(in.draws, settings.transmission, settings.materials);
    content.blendedFrom = settings.blend.layers > 0 ? opaqueAlpha : blendCutoff;
    out.g = drawGBuffer(f, in.draws, in.view, settings.materials, content);
    out.drawnDepth = out.g.depth;
    const bool aoReads =
        settings.ao.method == AoMethod::bitmask && settings.ao.thicknessMode == AoThickness::secondLayer;
    if (settings.traceScreen.thicknessMode == ThicknessMode::secondLayer || aoReads) {
        const gpu::Image back = drawBackDepth(f, in.draws, out.g.depth, in.view, content.withoutGlass);
        out.backDepth = keptDepth(f, back, in.view, settings.depth);
    }
    out.g.depth = keptDepth(f, out.g.depth, in.view, settings.depth);
    const bool traced = settings.traceScreen.enabled != 0 && (settings.diffuse.rays > 0 || settings.specular.rays > 0);
    if ((traced && settings.traceScreen.method == TraceMethod::hiz) || settings.contact.distance > 0.0F) {
        out.pyramid = makePyramid(f, out.g.depth, out.backDepth);
    }
}

// Sun visibility per pixel: shadow map, denoising, contact shadows.
void renderSunVisibility(gpu::Recorder& f, DirectViewStore* own, const ViewInputs& in, const Settings& settings,
                         ViewImages& out) {
    ShadowSettings shadow = settings.shadow;
    if (in.sunIrradiance == vec3(0.0F)) {
        shadow.filter = ShadowFilter::none;
    }
    const float sunSlope = std::tan(0.5F * in.sunAngularDiameter);
    out.sun = fitSunShadows(in.view, in.draws.boundsW, in.sunDirection, shadow,
                            filterReach(in.draws.boundsW, shadow, sunSlope));
    const bool glass = drawsGlass(in.draws, settings.transmission, settings.materials);
    const bool blended = settings.blend.layers > 0 && std::ranges::any_of(in.draws.draws, &Draw::blended);
    const bool throughBlended = shadow.filter != ShadowFilter::none && (blended || glass);
    if (shadow.filter != ShadowFilter::none && !out.shadowMap) {
        out.shadowMap = drawShadowMap(f, own->shadowMap, in.draws, out.sun, shadow, throughBlended);
    }
    ShadowInputs maps{.map = out.shadowMap, .range = {}, .blueNoise = in.blueNoise};
    if (shadow.filter == ShadowFilter::pcss && shadow.earlyOut != 0) {
        if (!out.shadowRange) {
            out.shadowRange =
                makeShadowRange(f, own->shadowRange, out.shadowMap, in.draws, out.sun, shadow, throughBlended);
        }
        maps.range = out.shadowRange;
    }
    const SunVisibility seen = sunVisibility(f, out.g, maps, {in.view, out.sun, shadow, sunSlope});
    out.rawSunVisibility = seen.visibility;
    out.shadowPenumbra = seen.penumbra;
    out.sunVisibility =
        shadow.denoise != 0 && seen.penumbra
            ? denoiseShadow(f, own != nullptr ? &own->sunVisibility : nullptr, out.g, seen.visibility, seen.penumbra,
                            {in.view, -in.sunDirection, shadow.history, shadow.samples, 0})
            : seen.visibility;
    out.cascadeIndex = seen.cascadeIndex;
    if (settings.contact.distance > 0.0F && in.sunIrradiance != vec3(0.0F)) {
        out.sunVisibility =
            contactShadow(f, out.g, out.pyramid, out.sunVisibility, {in.view, settings.contact, -in.sunDirection});
    }
    if (throughBlended) {
        if (!out.blendShadow.front().depth) {
            out.blendShadow = drawBlendShadowMaps(f, own->blendShadow, in.draws, out.sun, shadow);
        }
        out.sunVisibility = blendShadow(f, out.g, out.blendShadow, out.sunVisibility,
                                        {in.view, out.sun, shadow.resolution, shadow.bias});
    }
}

void renderLampVisibility(gpu::Recorder& f, DirectViewStore* own, const ViewInputs& in, const Settings& settings,
                          ViewImages& out) {
    out.lampTiles = findLampTiles(f, out.g.depth, in.lamps, in.view, settings.direct);
    if (in.lampShadows.count > 0) {
        if (!out.lampShadowMap) {
            out.lampShadowMap = drawLampShadowMap(f, own->lampShadowMap, in.draws, in.lampShadows);
        }
        out.lampVisibility = lampVisibility(f, out.g, {out.lampShadowMap, out.lampTiles.masks, in.blueNoise},
                                            in.lampShadows, {in.view, settings.shadow});
    }
}

}  // namespace

SceneLights sceneLights(const ViewInputs& in, const Settings& settings) {
    return {.toSun = -in.sunDirection,
            .sunSine = std::sin(0.5F * in.sunAngularDiameter),
            .sunIrradiance = in.sunIrradiance,
            .allLampsCast = settings.shadow.filter == ShadowFilter::traced ? 1U : 0U,
            .lambertOnly = settings.materials.lambertOnly};
}

ViewImages directView(gpu::Recorder& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                      gpu::Image lampShadowMap) {
    ViewImages out;
    out.lampShadowMap = lampShadowMap;
    drawSurfaces(f, in, settings, out);
    lightSurfaces(f, &own, in, settings, out);
    out.ambientOcclusion =
        ambientOcclusion(f, &own.ambientOcclusion,
                         {out.g, in.view, out.backDepth, settings.ao, settings.denoise, in.ggxTable, in.blueNoise});
    return out;
}

void lightSurfaces(gpu::Recorder& f, DirectViewStore* own, const ViewInputs& in, const Settings& settings,
                   ViewImages& out) {
    if (settings.shadow.filter == ShadowFilter::traced && in.traced != nullptr) {
        const DirectRays rays = directByRays(f, out.g, {*in.traced, in.ggxTable, in.environment, in.lamps},
                                             {in.view, sceneLights(in, settings), settings.shadow.rays});
        out.direct = rays.direct;
        out.sunVisibility = rays.sunVisibility;
        out.rawSunVisibility = rays.sunVisibility;
        return;
    }
    renderSunVisibility(f, own, in, settings, out);
    renderLampVisibility(f, own, in, settings, out);
    out.direct = directLight(f, out.g, {out.sunVisibility, out.lampVisibility, out.lampTiles.masks}, in.ggxTable,
                             {in.view, -in.sunDirection, in.sunIrradiance},
                             {in.lamps, in.environment, settings.materials.lambertOnly != 0});
}

}  // namespace reflet
