// What of a frame depends on the frames before it.
#include "renderer/history.h"

#include "lighting/jitter.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "renderer/settings.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr uint32_t settlingFrames = 32;  // the default length of every history that fades
constexpr uint32_t meanFrames = 64;

}  // namespace

HistoryUse historyUse(const Settings& settings) {
    const bool traced = lighting::tracesRays(settings);
    const bool reused = settings.traceScene.enabled != 0 &&
                        (settings.traceScene.reuseScreen != 0 || settings.traceScene.light == SceneHitLight::screen);
    const bool mean = settings.accumulate.enabled != 0;
    return {.shadows = lighting::keepsPenumbras(settings.shadow),
            .hitLight = traced && settings.traceScreen.light == HitLight::previous &&
                        (settings.traceScreen.enabled != 0 || reused),
            .probes = settings.probes.enabled != 0 && settings.probes.refresh == ProbeRefresh::face,
            .denoise = (traced || settings.ao.method != AoMethod::none) && settings.denoise.enabled != 0 &&
                       settings.denoise.history > 0,
            .temporal = settings.temporal.enabled != 0 && !mean,
            .accumulate = mean,
            .cameraTextures = false,
            .exposure = false};
}

HistoryUse historyUse(const Settings& settings, const Scene& scene) {
    HistoryUse use = historyUse(settings);
    use.cameraTextures = std::ranges::any_of(scene.materials, [](const Material& m) { return !m.camera.empty(); });
    use.exposure = exposesAutomatically(settings.tonemap, scene) && settings.tonemap.adaptation > 0.0F;
    return use;
}

uint32_t framesToSettle(HistoryUse use, const Settings& settings) {
    use.exposure = false;
    if (use.accumulate) {
        return meanFrames;
    }
    if (!use.any()) {
        return 1;
    }
    // Each round of all faces carries light one bounce further.
    // With upscaling a pixel has a sample of its own in scale² of the frames; twice as many at 0.5 leave little to
    // gain.
    const float upscaling = use.temporal ? settings.temporal.scale : 1.0F;
    const auto settled = static_cast<uint32_t>(std::ceil(static_cast<float>(settlingFrames) / upscaling));
    constexpr uint32_t facesOfAProbe = 6;
    const uint32_t captures = settings.probes.count * facesOfAProbe * (1 + settings.probes.bounces);
    return std::max(settled, use.probes ? captures : 0U);
}

uvec2 renderSize(const Settings& settings, uvec2 size) {
    const float scale = historyUse(settings).temporal ? settings.temporal.scale : 1.0F;
    return glm::max(uvec2(glm::round(vec2(size) * scale)), uvec2(1));
}

vec2 frameJitter(const Settings& settings, uint32_t frame, uint32_t framesBefore) {
    const HistoryUse use = historyUse(settings);
    if (use.accumulate) {
        return settings.accumulate.jitter != 0 ? subpixelJitter(framesBefore) : vec2(0.0F);
    }
    return use.temporal ? subpixelJitter(frame) : vec2(0.0F);
}

}  // namespace reflet
