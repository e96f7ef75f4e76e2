// Records ray tracing with the frame's parameters.
#include "renderer/scene_source.h"

#include "renderer/glass/glass.h"
#include "renderer/trace_scene/trace_scene.h"

#include <cmath>

namespace reflet {

namespace {

// Indirect light at hits: number of bounces, and whether only diffuse ones.
struct Scattering {
    uint32_t bounces = 0;
    bool diffuseOnly = false;
};

Scattering scatteringAtHits(const Settings& settings, uint32_t lobe) {
    const HitLight screen = settings.traceScreen.light;
    if (settings.traceScene.light == SceneHitLight::path || screen == HitLight::previous) {
        return {settings.traceScene.bounces, false};
    }
    const bool lit = screen == HitLight::lit && lobe == lobeSpecular && settings.diffuse.rays > 0;
    return {lit ? 1U : 0U, true};
}

uint32_t sunShadowsAtHits(const Settings& settings, const ViewImages& seen) {
    if (settings.shadow.filter == ShadowFilter::none) {
        return sunShadowNone;
    }
    return settings.traceScene.shadows == SceneShadows::map && seen.shadowMap ? sunShadowMap : sunShadowRay;
}

uint32_t throughGlass(const ViewInputs& in, const Settings& settings, const Rays& rays) {
    if (!refractsPaths(settings, in)) {
        return glassStraight;
    }
    return rays.ofView ? glassOfView : glassRefracts;
}

// Where each frame's paths have new noise, which the mean over frames at rest takes over.
float hitRadius(const Settings& settings, const ViewInputs& in) {
    const bool noisy = settings.traceScene.light == SceneHitLight::path && settings.denoise.enabled != 0;
    constexpr float share = 0.5F;  // of the denoiser's: what is blurred in the first frames takes long to fade
    return noisy ? share * settings.denoise.radius / std::sqrt(1.0F + static_cast<float>(in.view.rest)) : 0.0F;
}

}  // namespace

bool refractsPaths(const Settings& settings, const ViewInputs& in) {
    return settings.traceScene.enabled != 0 && in.traced != nullptr && !in.medium &&
           drawsGlass(in.draws, settings.transmission, settings.materials);
}

void traceSceneFallback(gpu::PassList& f, Rays& rays, const ViewInputs& in, const Settings& settings,
                        const ViewImages& seen, const ScreenImages& screen) {
    if (settings.traceScene.enabled == 0 || in.traced == nullptr) {
        return;
    }
    const Scattering scattering = scatteringAtHits(settings, rays.lobe);
    const float share =
        static_cast<float>(rays.count) / static_cast<float>(settings.diffuse.rays + settings.specular.rays);
    const bool previous = settings.traceScreen.light == HitLight::previous && screen.lit.valid;
    // Where hits bring all bounces, as the last frame does on screen.
    const bool all =
        settings.traceScene.light == SceneHitLight::screen && settings.traceScreen.light != HitLight::direct;
    const ProbeMaps none;
    traceScene(f, rays,
               {*in.traced, screen, seen.shadowMap, in.ggxTable, in.blueNoise, in.environment, in.lamps,
                all ? in.probes : none, all ? in.cache : CacheBuffers{}, throughGlass(in, settings, rays),
                hitRadius(settings, in)},
               sunShadowsAtHits(settings, seen),
               {.own = rays.from.view,
                .view = in.view,
                .settings = settings.traceScene,
                .lights = sceneLights(in, settings),
                .sun = seen.sun,
                .shadowBias = settings.shadow.bias,
                .rayLimit = 1000.0F * static_cast<float>(settings.traceScene.maxRays) * share,
                .bounces = scattering.bounces,
                .diffuseOnly = scattering.diffuseOnly ? 1U : 0U,
                .mips = settings.materials.mips,
                .fromPrevious = previous ? 1U : 0U,
                .firstRay = rays.firstRay,
                .cellSize = settings.radianceCache.cellSize,
                .samplesToEnd = in.cache.samplesToEnd});
}

}  // namespace reflet
