// The frame, top to bottom: values in, values out. Start reading here.
//
// direct view (G-buffer → depth pyramid → sun and lamp visibility → direct light) → diffuse rays → source chain
// → planar views → specular rays → source chain → composite → temporal antialiasing → tone map
//
// renderFrame, at the end, does all of it; its parts are above it, and those shared with other views in
// direct_view.cpp. There is no render graph: the `if`s in these two files are all that culls passes.
#include "render/frame.h"

#include "gpu/device.h"
#include "render/accumulate/accumulate.h"
#include "render/bounce/adaptive_rays.h"
#include "render/bounce/answer_environment.h"
#include "render/bounce/ray_tiles.h"
#include "render/bounce/reuse_rays.h"
#include "render/bounce/trace_screen.h"
#include "render/denoise/denoise.h"
#include "render/history.h"
#include "render/light_mips/light_mips.h"
#include "render/planar/planar_view.h"
#include "render/probe/answer_probes.h"
#include "render/scene_source.h"
#include "render/temporal/temporal.h"
#include "render/tonemap/tonemap.h"

#include <algorithm>
#include <string>
#include <vector>

namespace reflet {

namespace {

// Cones follow the lobe's centre, but on screen with a small random spread: the centre alone would give hit shapes
// edges as hard as in a mirror. Prefiltered sources have no such edges.
constexpr float coneShareOnScreen = 0.1F;

// A view's images, and the views that its rays are traced in.
struct TracedView {
    ViewImages images;
    ScreenImages screen;
    std::vector<PlanarView> mirrors;
};

// Screen-space tracing and planar reflections, in the order of the setting. Planar views see more than the screen and
// need no thickness assumption.
void traceScreenAndPlanar(gpu::Frame& f, Rays& rays, const TracedView& seen, const Settings& settings, float longest) {
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
gpu::Image noImageMotion(gpu::Frame& f, const RaySurfaces& from) {
    const gpu::Image motion = f.image("rays.image_motion", VK_FORMAT_R16G16_SFLOAT, from.g.depth.size);
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
RayTiles tilesOfLobe(gpu::Frame& f, const RaySurfaces& from, const Settings& settings, const gpu::History& lit,
                     uint32_t lobe) {
    const bool diffuse = lobe == lobeDiffuse;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const bool reused = (diffuse ? settings.diffuse.reuse : settings.specular.reuse) > 0;  // requires a fixed count
    const RayCounts counts{perPixel, reused ? perPixel : mirrorRayCount(perPixel, settings)};
    const bool hasHistory = historyUse(settings).denoise && lit.next;
    const bool adaptive = (diffuse ? settings.diffuse.adaptive : settings.specular.adaptive) != 0;
    if (!adaptive || !hasHistory || perPixel > raysPerBatch(f, from.g.depth.size, maxAdaptiveRays)) {
        return classifyTiles(f, from, lobe, counts);
    }
    const DenoiseHistory past = denoiseHistory(f, lobe, from.g.depth.size, settings.denoise);
    return shareRays(
        f, from, lobe, counts,
        {past.light.previous, past.surface.previous, past.moments.previous, lit.previous, past.valid && lit.valid});
}

// The chain of both lobes: rays, then sources in order of accuracy, each for the misses of the previous one.
LobeLight traceLobe(gpu::Frame& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                    uint32_t lobe) {
    const ScreenImages& screen = seen.screen;
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    const bool counted = settings.traceScreen.countSteps != 0;
    const uint32_t perPixel = diffuse ? settings.diffuse.rays : settings.specular.rays;
    const uint32_t neighbours = diffuse ? settings.diffuse.reuse : settings.specular.reuse;
    const float longest = diffuse ? settings.diffuse.maxDistance : settings.traceScreen.maxDistance;
    if (perPixel == 0 || in.draws.unlit) {
        return blackLobe(f, lobe, {screen.g, in.view}, counted);
    }
    const RaySurfaces from =
        pickSurfaces(f, screen.g, in.view, diffuse ? settings.diffuse.downsample : settings.specular.downsample);
    const float coneShare = settings.traceScreen.enabled != 0 ? coneShareOnScreen : 0.0F;
    const RayTiles tiles = tilesOfLobe(f, from, settings, screen.lit, lobe);
    const uint32_t most = tiles.meanRays > 0 ? adaptiveRayLimit(f, from.g.depth.size, perPixel) : perPixel;
    const uint32_t batch = tiles.meanRays > 0 ? most : raysPerBatch(f, from.g.depth.size);
    const bool hasHistory = historyUse(settings).denoise;
    const gpu::Image imageMotion = !diffuse && hasHistory ? noImageMotion(f, from) : gpu::Image{};
    const bool reused = neighbours > 0 && tiles.meanRays == 0 && batch >= perPixel;
    LobeLight light;
    for (uint32_t first = 0; first < most; first += batch) {
        const uint32_t count = std::min(most - first, batch);
        Rays rays = generateRays(f, from, {in.ggxTable, in.blueNoise, tiles}, lobe,
                                 {{}, settings.diffuse, settings.specular, first, count, coneShare}, counted);
        rays.imageMotion = imageMotion;
        rays.directional = diffuse && settings.denoise.enabled != 0 && settings.denoise.directional != 0;
        traceScreenAndPlanar(f, rays, seen, settings, longest);
        traceSceneFallback(f, rays, in, settings, seen.images, screen);
        if (in.probes) {
            answerProbes(f, rays, in.probes, settings.probes);
        }
        answerEnvironment(f, rays, in.environment, settings.environment);
        light = reused ? reuseRays(f, rays, in.view, neighbours) : resolveRays(f, rays);
    }
    light.imageMotion = imageMotion;
    return settings.denoise.enabled != 0 ? denoise(f, light, lobe, in.view, settings.denoise) : light;
}

TracedView tracedView(const ViewInputs& in, const ViewImages& images) {
    const ScreenImages screen{.g = images.g,
                              .view = in.view,
                              .backDepth = images.backDepth,
                              .pyramid = images.pyramid,
                              .light = images.direct,
                              .lit = {},
                              .lightMips = {}};
    return {images, screen, {}};
}

// Sets the light that reflections read at hits: direct light, or all light so far; and its mips for cones.
void lightForReflections(gpu::Frame& f, const ViewInputs& in, const Settings& settings, const LobeLight& diffuse,
                         ScreenImages& screen) {
    const auto scope = f.scope("specular");
    const SpecularSettings& s = settings.specular;
    const HitLight light = settings.traceScreen.light;
    if (light == HitLight::lit && s.rays > 0 && settings.diffuse.rays > 0) {
        const LobeLight none = blackLobe(f, lobeSpecular, {screen.g, in.view}, settings.traceScreen.countSteps != 0);
        const gpu::Image soFar = f.image("lit_so_far", VK_FORMAT_R16G16B16A16_SFLOAT, screen.light.size);
        const CompositeInputs parts{
            screen.g, screen.light, diffuse, none, in.ggxTable, settings.materials.lambertOnly != 0, false};
        screen.light = composite(f, parts, soFar, {in.view, settings.diffuse.gain}).lit;
    }
    if (s.roughFallback == RoughFallback::mips && s.maxRoughness < 1.0F && s.rays > 0) {
        screen.lightMips =
            makeLightMips(f, light == HitLight::previous && screen.lit.valid ? screen.lit.previous : screen.light);
    }
}

// Renders a planar view, for use by reflections. It has no last frame: `previous` acts as `lit` there.
ScreenImages renderReflectionView(gpu::Frame& f, const ViewInputs& in, Settings settings, gpu::Image lampShadowMap) {
    const bool lit = settings.traceScreen.light != HitLight::direct;
    settings.traceScreen.light = lit ? HitLight::lit : HitLight::direct;
    settings.traceScreen.countSteps = 0;
    settings.diffuse.rays = lit && settings.planar.diffuse != 0 ? settings.diffuse.rays : 0;
    settings.shadow.history = 0;  // the crop, and with it the pixels, moves with the camera
    settings.denoise.history = 0;
    const ViewImages images = directView(f, in, settings, lampShadowMap);
    TracedView seen = tracedView(in, images);
    const LobeLight diffuse = traceLobe(f, in, settings, seen, lobeDiffuse);
    lightForReflections(f, in, settings, diffuse, seen.screen);
    if (lit && settings.planar.specular != 0) {
        const LobeLight specular = traceLobe(f, in, settings, seen, lobeSpecular);
        const gpu::Image all = f.image("lit", VK_FORMAT_R16G16B16A16_SFLOAT, images.direct.size);
        const CompositeInputs parts{
            images.g, images.direct, diffuse, specular, in.ggxTable, settings.materials.lambertOnly != 0, false};
        seen.screen.light = composite(f, parts, all, {in.view, settings.diffuse.gain}).lit;
    }
    const bool blurred = settings.planar.form == PlanarForm::camera && settings.planar.cameraBlur > 1.0F;
    if (seen.screen.lightMips || blurred) {
        seen.screen.lightMips = makeLightMips(f, seen.screen.light);
    }
    return seen.screen;
}

ScreenImages renderPlanarView(gpu::Frame& f, const FrameInputs& in, const Settings& settings, const Mirror& mirror,
                              gpu::Image lampShadowMap) {
    const PlanarSettings& s = settings.planar;
    if (s.form == PlanarForm::duplicate) {
        const uint32_t largestMap = f.device().limits().maxImageDimension2D;
        const MirroredScene room = mirroredScene(in, mirror, settings.shadow, largestMap);
        ViewInputs behind = duplicateViewInputs(in, mirror, s, room);
        behind.traced = nullptr;  // these are not mirrored
        behind.probes = {};
        Settings there = settings;
        if (there.shadow.filter == ShadowFilter::traced) {
            there.shadow.filter = ShadowFilter::pcss;
        }
        return renderReflectionView(f, behind, there, {});
    }
    return renderReflectionView(f, mirrorViewInputs(in, mirror, s), settings, lampShadowMap);
}

std::vector<PlanarView> renderPlanarViews(gpu::Frame& f, const FrameInputs& in, const Settings& settings,
                                          gpu::Image lampShadowMap) {
    std::vector<PlanarView> views;
    for (const Mirror& mirror : in.mirrors) {
        const std::string name = "planar" + std::to_string(views.size());
        const auto scope = f.viewScope(name);
        views.push_back({name, renderPlanarView(f, in, settings, mirror, lampShadowMap),
                         mirrorParams(mirror, settings.planar), settings.planar.form});
    }
    return views;
}

// Renders the live camera images shown by materials. Returns the lamps' shadow map if one was drawn.
gpu::Image renderLiveCameras(gpu::Frame& f, const ViewInputs& in, const Settings& settings,
                             std::span<const LiveView> pictures) {
    gpu::Image lampShadowMap;
    for (size_t i = 0; i < pictures.size(); ++i) {
        const auto scope = f.viewScope("live" + std::to_string(i));
        ViewInputs view = in;
        view.view = pictures[i].view;
        const ViewImages seen = directView(f, view, settings, lampShadowMap);
        lampShadowMap = seen.lampShadowMap;
        showLive(f, seen.direct, pictures[i].picture);
    }
    return lampShadowMap;
}

}  // namespace

FrameImages renderFrame(gpu::Frame& f, const FrameInputs& in, const Settings& settings) {
    TracedView seen = tracedView(in, directView(f, in, settings, renderLiveCameras(f, in, settings, in.live)));
    const gpu::History lit = f.history("lit", VK_FORMAT_R16G16B16A16_SFLOAT, seen.images.g.depth.size);
    seen.screen.lit = lit;
    FrameImages out{seen.images};
    out.view = in.view;
    out.probeAtlas = in.probes.atlas;
    out.diffuse = traceLobe(f, in, settings, seen, lobeDiffuse);
    const bool reused = settings.traceScene.enabled != 0 && settings.traceScene.reuseScreen != 0;
    if (settings.traceScreen.enabled != 0 || reused) {
        lightForReflections(f, in, settings, out.diffuse, seen.screen);
    }
    seen.mirrors = renderPlanarViews(f, in, settings, out.lampShadowMap);
    out.specular = traceLobe(f, in, settings, seen, lobeSpecular);

    const bool layers = settings.composite.layers != 0 || settings.accumulate.enabled != 0;
    const CompositeInputs parts{
        out.g, out.direct, out.diffuse, out.specular, in.ggxTable, settings.materials.lambertOnly != 0, layers};
    out.light = composite(f, parts, lit.next, {in.view, settings.diffuse.gain});
    if (settings.accumulate.enabled != 0) {
        const LightLayers means = accumulate(f, {out.direct, out.light}, in.framesBefore);
        out.direct = means.direct;
        out.light = means.light;
    }
    out.unfiltered = out.light.lit;
    if (historyUse(settings).temporal) {
        out.temporal = temporal(f, out.g, out.light.lit, settings.temporal, in.view);
        out.light.lit = out.temporal;
    }
    out.display = tonemap(f, out.light.lit, settings.tonemap);
    return out;
}

}  // namespace reflet
