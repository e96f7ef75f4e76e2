// Names the sources of a lobe's rays.
#include "renderer/trace_lobe.h"

#include "effects/lobe/trace_screen.h"
#include "renderer/probe/answer_probes.h"
#include "renderer/scene_source.h"

#include <vector>

namespace reflet {

namespace {

// Cones follow the lobe's centre, but on screen with a small random spread: the centre alone would give hit shapes
// edges as hard as in a mirror. Prefiltered sources have no such edges.
constexpr float coneShareOnScreen = 0.1F;

// Whether tracing a mirror's ray again may find something else.
bool tracesAtRandom(const Settings& settings) {
    const TraceScreenSettings& s = settings.traceScreen;
    const bool exact = s.method == TraceMethod::hiz || s.method == TraceMethod::exhaustive;
    return (s.enabled != 0 && s.jitter != 0 && !exact) || settings.traceScene.enabled != 0;
}

// Whether planar views are asked before the screen.
bool startsWithMirrors(const Settings& settings, const TracedView& seen, uint32_t lobe) {
    return lobe == lobeSpecular && settings.planar.beforeScreen != 0 && !seen.mirrors.empty();
}

// In order of accuracy, each for the misses of the previous one. Planar views see more than the screen and need no
// thickness assumption; which of the two comes first is a setting. The screen is here only if it is not the first.
std::vector<RaySource> sourcesOf(const ViewInputs& in, const Settings& settings, const TracedView& seen, uint32_t lobe,
                                 float longest) {
    std::vector<RaySource> sources;
    if (lobe == lobeSpecular) {
        for (const PlanarView& mirror : seen.mirrors) {
            sources.emplace_back([&, longest](gpu::Recorder& f, Rays& rays) {
                traceMirror(f, rays, mirror, settings.traceScreen, longest);
            });
        }
    }
    if (settings.traceScreen.enabled != 0 && startsWithMirrors(settings, seen, lobe)) {
        sources.emplace_back([&, longest](gpu::Recorder& f, Rays& rays) {
            traceScreen(f, rays, seen.screen, settings.traceScreen, longest);
        });
    }
    if (settings.traceScene.enabled != 0 && in.traced != nullptr) {
        sources.emplace_back(
            [&](gpu::Recorder& f, Rays& rays) { traceSceneFallback(f, rays, in, settings, seen.images, seen.screen); });
    }
    if (in.probes) {
        sources.emplace_back([&](gpu::Recorder& f, Rays& rays) { answerProbes(f, rays, in.probes, settings.probes); });
    }
    return sources;
}

}  // namespace

LobeLight traceLobe(gpu::Recorder& f, LobeStore* own, const ViewInputs& in, const Settings& settings,
                    const TracedView& seen, uint32_t lobe) {
    LobeSettings common = lobe == lobeDiffuse ? lobeSettings(settings.diffuse) : lobeSettings(settings.specular);
    common.rays = in.draws.unlit ? 0 : common.rays;
    const float longest = lobe == lobeDiffuse ? settings.diffuse.maxDistance : settings.traceScreen.maxDistance;
    const std::vector<RaySource> sources = sourcesOf(in, settings, seen, lobe, longest);
    const bool first = settings.traceScreen.enabled != 0 && !startsWithMirrors(settings, seen, lobe);
    return traceLobe(f, own,
                     {.lobe = lobe,
                      .g = seen.images.g,
                      .view = in.view,
                      .settings = common,
                      .diffuse = settings.diffuse,
                      .specular = settings.specular,
                      .denoise = settings.denoise,
                      .environmentSettings = settings.environment,
                      .environment = in.environment,
                      .ggxTable = in.ggxTable,
                      .blueNoise = in.blueNoise,
                      .screen = {first ? &seen.screen : nullptr, settings.traceScreen, longest},
                      .sources = sources,
                      .ambientOcclusion = seen.images.ambientOcclusion,
                      .lit = seen.screen.lit,
                      .randomTracing = tracesAtRandom(settings),
                      .countSteps = settings.traceScreen.countSteps != 0,
                      .coneShare = settings.traceScreen.enabled != 0 ? coneShareOnScreen : 0.0F});
}

void answerRays(gpu::Recorder& f, Rays& rays, const ViewInputs& in, const Settings& settings, const TracedView& seen) {
    const float longest = settings.traceScreen.maxDistance;
    if (settings.traceScreen.enabled != 0) {
        traceScreen(f, rays, seen.screen, settings.traceScreen, longest);
    }
    for (const RaySource& source : sourcesOf(in, settings, seen, rays.lobe, longest)) {
        source(f, rays);
    }
    answerEnvironment(f, rays, in.environment, settings.environment);
}

}  // namespace reflet
