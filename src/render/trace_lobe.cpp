// Traces a lobe: picks surfaces, generates rays, asks the sources in turn, resolves and denoises.
#include "render/trace_lobe.h"

#include "gpu/context.h"
#include "render/bounce/adaptive_rays.h"
#include "render/bounce/answer_environment.h"
#include "render/bounce/ray_tiles.h"
#include "render/bounce/reuse_rays.h"
#include "render/bounce/trace_screen.h"
#include "render/denoise/denoise.h"
#include "render/history.h"
#include "render/probe/answer_probes.h"
#include "render/scene_source.h"

#include <algorithm>
#include <string>

namespace reflet {

namespace {

// Cones follow the lobe's centre, but on screen with a small random spread: the centre alone would give hit shapes
// edges as hard as in a mirror. Prefiltered sources have no such edges.
constexpr float coneShareOnScreen = 0.1F;

// Screen-space tracing and planar reflections, in the order of the setting. Planar views see more than the screen and
// need no thickness assumption.
void traceScreenAndPlanar(gpu::Recorder& f, Rays& rays, const TracedView& seen, const Settings& settings, float longest) {
    const bool screenFirst = settings.planar.beforeScreen == 0;
    for (const bool asksScreen : {screenFirst, !screenFirst}) {
        if (asksScreen && settings.traceScreen.enabled != 0) {
            traceScreen(f, rays, seen.screen, settings.traceScreen, longest);
        }
        if (!asksScreen && rays.lobe == lobeSpecular) {
            for (const PlanarView& mirror : seen.mirrors) {
                traceMirror(f, rays, mirror, settings.traceScreen, longest);
            }
        }
    }
}

// No motion of reflected images, unless a source overwrites it.
gpu::Image noImageMotion(gpu::Recorder& f, gpu::KeptImage& own, const RaySurfaces& from) {
    const gpu::Image motion = own.storage(f, VK_FORMAT_R16G16_SFLOAT, from.g.depth.size);
    f.clear(motion);
    return motion;
}

// Rays per pixel of mirrors. All rays of a pixel are identical unless their tracing is randomized.
uint32_t mirrorRayCount(uint32_t perPixel, const Settings& settings) {
    const TraceScreenSettings& s = settings.traceScreen;
    const bool exact = s.method == TraceMethod::hiz || s.method == TraceMethod::exhaustive;
    const bool chance = (s.enabled != 0 && s.jitter != 0 && !exact) || settings.traceScene.enabled != 0;
    return chance ? perPixel : std::min(perPixel, 1U);
}

// Rays per tile. Adaptive sampling needs the denoiser's history.
RayTiles tilesOfLobe(gpu::Recorder& f, gpu::Scratch& scratch, LobeStore& own, const RaySurfaces& from,
                     const Settings& settings, const gpu::History& lit, uint32_t lobe) {
    const bool diffuse = lobe == lobeDiffuse;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const bool reused = (diffuse ? settings.diffuse.reuse : settings.specular.reuse) > 0;  // requires a fixed count
    const RayCounts counts{perPixel, reused ? perPixel : mirrorRayCount(perPixel, settings)};
    const bool hasHistory = historyUse(settings).denoise && lit.next;
    const bool adaptive = (diffuse ? settings.diffuse.adaptive : settings.specular.adaptive) != 0;
    if (!adaptive || !hasHistory || perPixel > raysPerBatch(f, from.g.depth.size, maxAdaptiveRays)) {
        return classifyTiles(f, scratch, own.tiles, from, lobe, counts);
    }
    const DenoiseHistory past = denoiseHistory(f, own.denoise, lobe, from.g.depth.size, settings.denoise);
    return shareRays(
        f, scratch, own.adaptiveTiles, from, lobe, counts,
        {past.light.previous, past.surface.previous, past.moments.previous, lit.previous, past.valid && lit.valid});
}

}  // namespace

LobeLight traceLobe(gpu::Recorder& f, LobeStore& own, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe) {
    const ScreenImages& screen = seen.screen;
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    const bool counted = settings.traceScreen.countSteps != 0;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const uint32_t neighbours = diffuse ? settings.diffuse.reuse : settings.specular.reuse;
    const float longest = diffuse ? settings.diffuse.maxDistance : settings.traceScreen.maxDistance;
    if (perPixel == 0 || in.draws.unlit) {
        return blackLobe(f, own.light, {seen.images.g, in.view}, counted);
    }
    const RaySurfaces from = pickSurfaces(f, own.surfaces, seen.images.g, in.view,
                                          diffuse ? settings.diffuse.downsample : settings.specular.downsample);
    gpu::Scratch scratch(f);
    const float coneShare = settings.traceScreen.enabled != 0 ? coneShareOnScreen : 0.0F;
    const RayTiles tiles = tilesOfLobe(f, scratch, own, from, settings, screen.lit, lobe);
    const uint32_t most = tiles.meanRays > 0 ? adaptiveRayLimit(f, from.g.depth.size, perPixel) : perPixel;
    const uint32_t batch = tiles.meanRays > 0 ? most : raysPerBatch(f, from.g.depth.size);
    const bool hasHistory = historyUse(settings).denoise;
    const gpu::Image imageMotion = !diffuse && hasHistory ? noImageMotion(f, own.light.imageMotion, from) : gpu::Image{};
    const bool reused = neighbours > 0 && tiles.meanRays == 0 && batch >= perPixel;
    LobeLight light;
    for (uint32_t first = 0; first < most; first += batch) {
        const uint32_t count = std::min(most - first, batch);
        gpu::Scratch ofBatch(f);
        Rays rays = generateRays(f, ofBatch, from, {in.ggxTable, in.blueNoise, tiles}, lobe,
                                 {{}, settings.diffuse, settings.specular, first, count, coneShare}, counted);
        rays.imageMotion = imageMotion;
        rays.directional = diffuse && settings.denoise.enabled != 0 && settings.denoise.directional != 0;
        traceScreenAndPlanar(f, rays, seen, settings, longest);
        traceSceneFallback(f, rays, in, settings, seen.images, screen);
        if (in.probes) {
            answerProbes(f, rays, in.probes, settings.probes);
        }
        answerEnvironment(f, rays, in.environment, settings.environment);
        light = reused ? reuseRays(f, own.light, rays, in.view, neighbours) : resolveRays(f, own.light, rays);
    }
    light.imageMotion = imageMotion;
    return settings.denoise.enabled != 0 ? denoise(f, own.denoise, light, lobe, in.view, settings.denoise) : light;
}

}  // namespace reflet
