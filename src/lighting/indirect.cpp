// Records the stages of indirect light.
#include "lighting/indirect.h"

#include "base/error.h"
#include "effects/composite/composite.h"
#include "effects/light_mips/light_mips.h"
#include "effects/lobe/answer_environment.h"

namespace reflet::lighting {

namespace {

// Cones follow the lobe's centre, but on screen with a small random spread: the centre alone would give hit shapes
// edges as hard as in a mirror. Prefiltered sources have no such edges.
constexpr float coneShareOnScreen = 0.1F;

// Whether marching the same ray again finds the same.
bool marchesExactly(const TraceScreenSettings& settings) {
    return settings.method == TraceMethod::hiz || settings.method == TraceMethod::exhaustive;
}

bool tracesAtRandom(const LightingSettings& settings, const RaySources& sources) {
    const TraceScreenSettings& s = settings.traceScreen;
    return (s.enabled != 0 && s.jitter != 0 && !marchesExactly(s)) || sources.random;
}

float longestRay(const LightingSettings& settings, uint32_t lobe) {
    return lobe == lobeDiffuse ? settings.diffuse.maxDistance : settings.traceScreen.maxDistance;
}

TraceScreenSettings marchOf(const LightingSettings& settings, const ScreenImages& screen) {
    TraceScreenSettings march = settings.traceScreen;
    if (!screen.backDepth && march.thicknessMode == ThicknessMode::secondLayer) {
        march.thicknessMode = ThicknessMode::constant;
    }
    return march;
}

bool startsWithMirrors(const RaySources& sources, uint32_t lobe) {
    return lobe == lobeSpecular && sources.mirrorsFirst && !sources.mirrors.empty();
}

// In order of accuracy, each for the misses of the one before. Planar views see more than the screen and need no
// thickness assumption; which of the two comes first is a setting. The screen is here only if it is not the first.
std::vector<RaySource> orderOf(const LightingSettings& settings, const ScreenImages& screen, const RaySources& sources,
                               uint32_t lobe) {
    const float longest = longestRay(settings, lobe);
    const TraceScreenSettings march = marchOf(settings, screen);
    std::vector<RaySource> order;
    if (lobe == lobeSpecular) {
        for (const PlanarView& mirror : sources.mirrors) {
            order.emplace_back([&mirror, march = settings.traceScreen, longest](gpu::PassList& f, Rays& rays) {
                traceMirror(f, rays, mirror, march, longest);
            });
        }
    }
    if (settings.traceScreen.enabled != 0 && startsWithMirrors(sources, lobe)) {
        order.emplace_back(
            [&screen, march, longest](gpu::PassList& f, Rays& rays) { traceScreen(f, rays, screen, march, longest); });
    }
    return order;
}

// Refers to what it is given. first: the screen, if it is asked before all others.
LobeInputs inputsOf(const ViewContext& in, const LightingSettings& settings, uint32_t lobe, const Surfaces& surfaces,
                    const ScreenSource& first) {
    LobeSettings rays = lobe == lobeDiffuse ? lobeSettings(settings.diffuse) : lobeSettings(settings.specular);
    rays.rays = in.unlit ? 0 : rays.rays;
    return {.lobe = lobe,
            .g = surfaces.g,
            .view = in.view,
            .settings = rays,
            .diffuse = settings.diffuse,
            .specular = settings.specular,
            .denoise = settings.denoise,
            .environmentSettings = settings.environment,
            .environment = in.environment,
            .ggxTable = in.ggxTable,
            .blueNoise = in.blueNoise,
            .screen = first,
            .sources = {},
            .others = {},
            .cache = lobe == lobeDiffuse ? in.cache : CacheBuffers{},
            .ambientOcclusion = surfaces.ambientOcclusion,
            .followsImages = settings.temporal.enabled != 0 && settings.temporal.reflections != 0,
            .countSteps = settings.traceScreen.countSteps != 0,
            .countHits = settings.traceScreen.countHits != 0,
            .coneShare = settings.traceScreen.enabled != 0 ? coneShareOnScreen : 0.0F,
            .roughestHighlight = in.roughestHighlight};
}

ScreenImages screenForLobe(const ViewContext& in, uint32_t lobe, ScreenImages seen, bool certainNext) {
    seen.certainNext = certainNext;
    const EmittersAtHits highlighted =
        in.roughestHighlight > 0.0F ? EmittersAtHits::notHighlighted : EmittersAtHits::all;
    seen.emitters = in.emitterLamps && lobe == lobeDiffuse ? EmittersAtHits::none : highlighted;
    // Without a source that follows what metals mirror, their picture is better than none. Reflected suns alone bring
    // their light to other surfaces.
    const bool asLamps = in.reflectedSuns && lobe == lobeDiffuse;
    seen.metalsLeftOut = certainNext ? MetalsLeftOut::smooth : asLamps ? MetalsLeftOut::mirrors : MetalsLeftOut::none;
    return seen;
}

// Whether rays would read the last picture, and there is none: in the first frame.
bool lacksPicture(const ViewContext& in, const LightingSettings& settings, const ScreenImages& screen) {
    return settings.traceScreen.light == HitLight::previous && in.composes && screen.lit.next && !screen.lit.valid;
}

LobeLight traceOnce(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                    uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources) {
    const ScreenImages screen = screenForLobe(in, lobe, seen, sources.certainOthers > 0);
    const bool first = settings.traceScreen.enabled != 0 && !startsWithMirrors(sources, lobe);
    const std::vector<RaySource> order = orderOf(settings, screen, sources, lobe);
    LobeInputs inputs = inputsOf(in, settings, lobe, surfaces,
                                 {first ? &screen : nullptr, marchOf(settings, screen), longestRay(settings, lobe)});
    inputs.sources = order;
    inputs.others = sources.others;
    inputs.certainOthers = sources.certainOthers;
    inputs.lit = screen.lit;
    inputs.randomTracing = tracesAtRandom(settings, sources);
    return reflet::traceLobe(f, history, inputs);
}

// What rays read at hits, with the reflections that have been traced.
gpu::Image withReflections(gpu::PassList& f, const ViewContext& in, const ScreenImages& screen,
                           const LobeLight& specular) {
    const LobeLight none = reflet::blackLobe(f, {screen.g, in.view}, false);
    const gpu::Image sum = f.image("lit_once", VK_FORMAT_R16G16B16A16_SFLOAT, screen.light.size);
    const CompositeInputs parts{screen.g, screen.light, none, specular, in.ggxTable, in.lambertOnly, false};
    return composite(f, parts, sum, {in.view, 1.0F}).lit;
}

// The screen as reflection rays read it. Where there is no last picture, they are traced once before, so that mirrors
// show what mirrors show.
ScreenImages litOnce(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                     uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources) {
    if (lobe != lobeSpecular || settings.traceScreen.enabled == 0 || !lacksPicture(in, settings, seen)) {
        return seen;
    }
    const LobeLight traced = traceOnce(f, history, in, settings, lobe, surfaces, seen, sources);
    if (traced.dark) {
        return seen;
    }
    const auto scope = f.scope("specular");
    ScreenImages lit = seen;
    lit.light = withReflections(f, in, seen, traced);
    if (lit.lightMips) {
        lit.lightMips = makeLightMips(f, lit.light);
    }
    return lit;
}

}  // namespace

PendingLobe beginLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources) {
    const ScreenImages screen =
        screenForLobe(in, lobe, litOnce(f, history, in, settings, lobe, surfaces, seen, sources), true);
    const bool marched = settings.traceScreen.enabled != 0 && !startsWithMirrors(sources, lobe);
    const std::vector<RaySource> order = orderOf(settings, screen, sources, lobe);
    LobeInputs inputs = inputsOf(in, settings, lobe, surfaces,
                                 {marched ? &screen : nullptr, marchOf(settings, screen), longestRay(settings, lobe)});
    inputs.sources = order;
    inputs.lit = screen.lit;
    inputs.randomTracing = tracesAtRandom(settings, sources);
    if (inputs.settings.rays == 0) {
        failUsage("{}.rays: is 0, so that no rays can miss; set 1 or more",
                  lobe == lobeDiffuse ? "diffuse" : "specular");
    }
    PendingLobe pending{lobe, settings, reflet::beginLobe(f, history, inputs), {}};
    const auto scope = f.scope(lobe == lobeDiffuse ? "diffuse" : "specular");
    pending.missed = listMissed(f, pending.begun);
    return pending;
}

LobeLight finishLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const Surfaces& surfaces,
                     const PendingLobe& pending, std::span<const RaySource> others) {
    std::vector<RaySource> order{
        [&](gpu::PassList& list, Rays& rays) { takeAnswers(list, rays, pending.missed.answers); }};
    order.insert(order.end(), others.begin(), others.end());
    LobeInputs inputs = inputsOf(in, pending.settings, pending.lobe, surfaces, {});
    inputs.others = order;
    inputs.certainOthers = 1;
    return reflet::finishLobe(f, history, inputs, pending.begun);
}

ScreenImages screenOf(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, Surfaces& surfaces,
                      gpu::Image direct, const gpu::History& lit) {
    if (tracesRays(settings) && marchesPyramid(settings)) {
        depthPyramid(f, surfaces);
    }
    return {.g = surfaces.g,
            .view = in.view,
            .backDepth = surfaces.backDepth,
            .pyramid = surfaces.pyramid,
            .light = direct,
            .lit = lit,
            .lightMips = {}};
}

bool marchesPyramid(const LightingSettings& settings) {
    return settings.traceScreen.enabled != 0 && settings.traceScreen.method == TraceMethod::hiz;
}

void addPyramidOfPlanarView(gpu::PassList& f, const LightingSettings& settings, Surfaces& surfaces,
                            ScreenImages& screen) {
    if (settings.traceScreen.method == TraceMethod::hiz && !screen.pyramid) {
        screen.pyramid = depthPyramid(f, surfaces);
    }
}

bool readsScreenLight(const LightingSettings& settings, const RaySources& sources) {
    return settings.traceScreen.enabled != 0 || sources.readScreen;
}

LobeLight traceLobe(gpu::PassList& f, LobeStore* history, const ViewContext& in, const LightingSettings& settings,
                    uint32_t lobe, const Surfaces& surfaces, const ScreenImages& seen, const RaySources& sources) {
    const ScreenImages lit = litOnce(f, history, in, settings, lobe, surfaces, seen, sources);
    return traceOnce(f, history, in, settings, lobe, surfaces, lit, sources);
}

LobeLight denoiseLobe(gpu::PassList& f, LobeStore& history, const ViewContext& in, const LightingSettings& settings,
                      uint32_t lobe, const Surfaces& surfaces, gpu::Image noisy) {
    const auto scope = f.scope(lobe == lobeDiffuse ? "diffuse" : "specular");
    LobeLight light;
    light.from = {surfaces.g, in.view, 1};
    light.radiance = noisy;
    light.source = light.radiance;
    return denoise(f, &history.denoise, light, lobe, in.view, settings.denoise);
}

void answerRays(gpu::PassList& f, Rays& rays, const ViewContext& in, const LightingSettings& settings,
                const ScreenImages& screen, const RaySources& sources) {
    if (settings.traceScreen.enabled != 0) {
        traceScreen(f, rays, screen, marchOf(settings, screen), longestRay(settings, rays.lobe));
    }
    for (const RaySource& source : sources.others) {
        source(f, rays);
    }
    answerEnvironment(f, rays, in.environment, settings.environment);
}

gpu::Image lightSoFar(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings,
                      const ScreenImages& screen, const LobeLight& diffuse) {
    const bool read = settings.traceScreen.light == HitLight::lit || lacksPicture(in, settings, screen);
    if (!read || settings.specular.rays == 0 || diffuse.dark) {
        return screen.light;
    }
    const auto scope = f.scope("specular");
    const LobeLight none = blackLobe(f, {screen.g, in.view}, settings.traceScreen.countSteps != 0);
    const gpu::Image soFar = f.image("lit_so_far", VK_FORMAT_R16G16B16A16_SFLOAT, screen.light.size);
    const CompositeInputs parts{screen.g, screen.light, diffuse, none, in.ggxTable, in.lambertOnly, false};
    return composite(f, parts, soFar, {in.view, settings.diffuse.gain}).lit;
}

void prefilterLight(gpu::PassList& f, const LightingSettings& settings, ScreenImages& screen) {
    if (!raysSpread(lobeSpecular, settings.diffuse, settings.specular)) {
        return;
    }
    const bool previous = settings.traceScreen.light == HitLight::previous && screen.lit.valid;
    screen.lightMips = makeLightMips(f, previous ? screen.lit.previous : screen.light);
}

ScreenImages lightAtHits(gpu::PassList& f, const ViewContext& in, const LightingSettings& settings, uint32_t lobe,
                         ScreenImages screen, const LobeLight* diffuse) {
    if (lobe == lobeDiffuse) {
        return screen;
    }
    if (diffuse != nullptr) {
        screen.light = lightSoFar(f, in, settings, screen, *diffuse);
    }
    prefilterLight(f, settings, screen);
    return screen;
}

void prefilterOwnLight(gpu::PassList& f, ScreenImages& screen) {
    screen.lightMips = makeLightMips(f, screen.light);
}

}  // namespace reflet::lighting
