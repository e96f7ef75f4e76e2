// The frame, top to bottom: values in, values out. Start reading here.
//
//     G-buffer → depth pyramid → sun and lamp visibility → direct light → diffuse rays, specular rays → answer chain
//     → composite → tone map
//
// renderFrame, at the end, is all of it; its parts stand above it. There is no graph compiler: an `if` in this file is
// the only culling.
#include "render/frame.h"

#include "render/bounce/answer_environment.h"
#include "render/bounce/trace_screen.h"
#include "render/contact/contact.h"
#include "render/gbuffer/back_depth.h"
#include "render/light_mips/light_mips.h"
#include "render/pyramid/pyramid.h"
#include "render/shadow/shadow.h"
#include "render/shadow/shadow_clean.h"
#include "render/tonemap/tonemap.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

void drawSurfaces(gpu::Frame& f, const FrameInputs& in, const Settings& settings, FrameImages& out) {
    out.g = drawGBuffer(f, in.draws, in.view, settings.materials);
    if (settings.traceScreen.thicknessFrom == ThicknessFrom::secondLayer) {
        const gpu::Image back = drawBackDepth(f, in.draws, out.g.depth, in.view);
        out.backDepth = keptDepth(f, "kept_back_depth", back, in.view, settings.depth);
    }
    out.g.depth = keptDepth(f, "kept_depth", out.g.depth, in.view, settings.depth);
    if (settings.traceScreen.method == TraceMethod::hiz || settings.contact.distance > 0.0F) {
        out.pyramid = makePyramid(f, out.g.depth, out.backDepth);
    }
}

// How much of the sun each pixel sees: its shadow map, cleaned, and contact shadows.
void seeSun(gpu::Frame& f, const FrameInputs& in, const Settings& settings, FrameImages& out) {
    ShadowSettings shadow = settings.shadow;
    if (in.sunIrradiance == vec3(0.0F)) {
        shadow.filter = ShadowFilter::none;
    }
    const float sunSlope = std::tan(0.5F * in.sunAngularDiameter);
    const SunShadowParams sun = fitSunShadows(in.view, in.draws.boundsW, in.sunDirection, shadow,
                                              filterReach(in.draws.boundsW, shadow, sunSlope));
    if (shadow.filter != ShadowFilter::none) {
        out.shadowMap = drawShadowMap(f, in.draws, sun, shadow);
    }
    ShadowInputs maps{.map = out.shadowMap, .range = {}, .blueNoise = in.blueNoise};
    if (shadow.filter == ShadowFilter::pcss && shadow.earlyOut != 0) {
        maps.range = makeShadowRange(f, out.shadowMap);
    }
    const SunVisibility seen = sunVisibility(f, out.g, maps, {in.view, sun, shadow, sunSlope});
    out.rawSunVisibility = seen.visibility;
    out.shadowPenumbra = seen.penumbra;
    out.sunVisibility = shadow.clean != 0 && seen.penumbra
                            ? cleanShadow(f, out.g, seen.visibility, seen.penumbra,
                                          {in.view, -in.sunDirection, shadow.history, shadow.samples, 0})
                            : seen.visibility;
    out.cascadeIndex = seen.cascadeIndex;
    if (settings.contact.distance > 0.0F && in.sunIrradiance != vec3(0.0F)) {
        out.sunVisibility =
            contactShadow(f, out.g, out.pyramid, out.sunVisibility, {in.view, settings.contact, -in.sunDirection});
    }
}

void lightDirectly(gpu::Frame& f, const FrameInputs& in, const Settings& settings, FrameImages& out) {
    seeSun(f, in, settings, out);
    if (in.lampShadows.count > 0) {
        out.lampShadowMap = drawLampShadowMap(f, in.draws, in.lampShadows);
        out.lampVisibility =
            lampVisibility(f, out.g, {out.lampShadowMap, {}, in.blueNoise}, in.lampShadows, {in.view, settings.shadow});
    }
    if (in.lamps.count > 0 && settings.direct.lampTiles != 0) {
        out.lampTiles = findLampTiles(f, out.g.depth, in.lamps, in.view);
    }
    out.direct = directLight(f, out.g, {out.sunVisibility, out.lampVisibility, out.lampTiles.masks}, in.ggxTable,
                             {in.view, -in.sunDirection, in.sunIrradiance, in.environment}, in.lamps);
}

// One chain for both lobes: rays, then sources that answer in order of trust, each taking what is left over.
LobeLight traceLobe(gpu::Frame& f, const FrameInputs& in, const Settings& settings, const ScreenImages& screen,
                    uint32_t lobe) {
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    const uvec2 size = screen.g.depth.size;
    const bool counted = settings.traceScreen.countSteps != 0;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const float longest = diffuse ? settings.diffuse.radius : settings.traceScreen.maxDistance;
    if (perPixel == 0) {
        return noLight(f, lobe, size, counted);
    }
    const uint32_t batch = raysPerBatch(f, size);
    LobeLight light;
    for (uint32_t first = 0; first < perPixel; first += batch) {
        const uint32_t count = std::min(perPixel - first, batch);
        Rays rays = generateRays(f, screen.g, {in.ggxTable, in.blueNoise}, lobe,
                                 {in.view, settings.diffuse, settings.specular, first, count}, counted);
        traceScreen(f, rays, screen, in.view, settings.traceScreen, longest);
        answerEnvironment(f, rays, screen.g, in.environment, settings.environment);
        light = resolveRays(f, rays, perPixel);
    }
    return light;
}

// What reflections show: direct light, or what is lit so far; and its mips for those that are too rough for rays.
void lightForReflections(gpu::Frame& f, const FrameInputs& in, const Settings& settings, const FrameImages& out,
                         ScreenImages& screen) {
    const auto scope = f.scope("specular");
    const SpecularSettings& s = settings.specular;
    const HitLight light = settings.traceScreen.light;
    if (light == HitLight::lit && s.rays > 0 && settings.diffuse.rays > 0) {
        const LobeLight none = noLight(f, lobeSpecular, out.g.depth.size, settings.traceScreen.countSteps != 0);
        const gpu::Image soFar = f.image("lit_so_far", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
        screen.light =
            composite(f, out.g, out.direct, out.diffuse, none, in.ggxTable, soFar, {in.view, settings.diffuse.gain})
                .lit;
    }
    if (s.rougher == RougherSurfaces::mips && s.maxRoughness < 1.0F && s.rays > 0) {
        screen.coneRoughness = s.maxRoughness;
        screen.lightMips =
            makeLightMips(f, light == HitLight::previous && screen.lit.valid ? screen.lit.previous : screen.light);
    }
}

}  // namespace

FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings) {
    FrameImages out;
    drawSurfaces(f, in, settings, out);
    lightDirectly(f, in, settings, out);

    const gpu::History lit = f.history("lit", VK_FORMAT_R16G16B16A16_SFLOAT, out.g.depth.size);
    ScreenImages screen{
        .g = out.g, .backDepth = out.backDepth, .pyramid = out.pyramid, .light = out.direct, .lit = lit};
    out.diffuse = traceLobe(f, in, settings, screen, lobeDiffuse);
    lightForReflections(f, in, settings, out, screen);
    out.specular = traceLobe(f, in, settings, screen, lobeSpecular);

    out.light = composite(f, out.g, out.direct, out.diffuse, out.specular, in.ggxTable, lit.next,
                          {in.view, settings.diffuse.gain});
    out.display = tonemap(f, out.light.lit, settings.tonemap);
    return out;
}

}  // namespace reflet
