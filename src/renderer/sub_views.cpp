// Settings of sub-views.
#include "renderer/sub_views.h"

#include "renderer/draw_list.h"

#include <algorithm>

namespace reflet {

Settings layerSettings(Settings settings) {
    settings.contact.distance = 0.0F;
    settings.diffuse.method = DiffuseMethod::rays;  // slices start in the view that they walk through
    settings.traceScreen.countSteps = 0;
    settings.traceScreen.countHits = 0;
    return settings;
}

Settings glassSettings(const Settings& settings, const DrawList& draws) {
    Settings layer = layerSettings(settings);
    layer.traceScreen.light = HitLight::lit;
    if (!draws.murky) {
        layer.diffuse.rays = 0;  // nothing reflects diffusely
    }
    return layer;
}

Settings refractedSettings(Settings settings) {
    settings.traceScreen.enabled = settings.traceScreen.enabled != 0 || settings.traceScene.enabled != 0 ? 1U : 0U;
    return settings;
}

Settings coatSettings(const Settings& settings) {
    Settings layer = layerSettings(settings);
    layer.diffuse.rays = 0;
    return layer;
}

Settings otherSideSettings(const Settings& settings) {
    Settings layer = layerSettings(settings);
    layer.materials.lambertOnly = 1;
    layer.specular.rays = 0;
    layer.traceScreen.enabled = 0;
    return layer;
}

Settings planarSettings(Settings settings) {
    settings.shadow.cascades = std::max(settings.shadow.cascades, 1U);
    const bool lit = settings.traceScreen.light != HitLight::direct;
    settings.traceScreen.light = lit ? HitLight::lit : HitLight::direct;
    settings.traceScreen.countSteps = 0;
    settings.traceScreen.countHits = 0;
    settings.diffuse.rays = lit && settings.planar.diffuse != 0 ? settings.diffuse.rays : 0;
    return settings;
}

Settings duplicateSettings(const Settings& settings) {
    Settings there = planarSettings(settings);
    if (there.shadow.filter == ShadowFilter::traced) {
        there.shadow.filter = ShadowFilter::pcss;
    }
    return there;
}

Settings probeLightSettings(Settings settings) {
    settings.traceScreen.enabled = 0;
    settings.traceScene.enabled = 0;
    settings.denoise.enabled = 0;
    settings.diffuse.rays = 1;
    settings.diffuse.distribution = RayDistribution::normal;
    settings.diffuse.adaptive = 0;
    settings.diffuse.reuse = 0;
    return settings;
}

Settings liveSettings(Settings settings) {
    settings.blend.layers = 0;
    settings.transmission.layers = 0;
    return settings;
}

Settings captureSettings(Settings settings) {
    settings.depth = {};
    settings.blend.layers = 0;
    settings.transmission.layers = 0;
    settings.contact.distance = 0.0F;
    settings.traceScreen.method = TraceMethod::linear;  // no pyramid
    settings.traceScreen.thicknessMode = ThicknessMode::constant;
    if (settings.shadow.filter != ShadowFilter::none) {
        settings.shadow.filter = ShadowFilter::hard;
    }
    settings.shadow.cascades = 1;
    settings.shadow.resolution = std::min(settings.shadow.resolution, 1024U);
    return settings;
}

}  // namespace reflet
