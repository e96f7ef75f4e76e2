// Records the views of mirrors. They have no history: their crop, and with it their pixels, moves with the camera.
#include "renderer/planar_views/render_planar.h"

#include "gpu/context.h"
#include "lighting/indirect.h"
#include "lighting/picture.h"
#include "renderer/coat/coat.h"
#include "renderer/glass/glass_layers.h"
#include "renderer/sub_views.h"
#include "renderer/view_light.h"

#include <algorithm>
#include <string>

namespace reflet {

namespace {

// Direct light with diffuse light from the probes, if there are any.
gpu::Image withProbeLight(gpu::PassList& f, const ViewInputs& in, const Settings& asked, const TracedView& seen) {
    if (!in.probes) {
        return seen.images.direct;
    }
    const auto scope = f.scope("ambient");
    const Settings settings = probeLightSettings(asked);
    const lighting::ViewContext context = contextOf(in, settings);
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, seen, lobeDiffuse);
    const LobeLight none = lighting::blackLobe(f, context, seen.images, lobeSpecular);
    return lighting::compose(f, context, settings, seen.images, {seen.images.direct, diffuse, none}, false).lit;
}

// All light of the view, with its own reflections, coats and glass. light: what these read at hits so far.
LightLayers reflectingLight(gpu::PassList& f, const ViewInputs& in, const Settings& settings, const TracedView& seen,
                            gpu::Image base, const LobeLight& diffuse, const BlendedSurfaces& blended) {
    const LobeLight specular = traceLobe(f, nullptr, in, settings, seen, lobeSpecular);
    LightLayers light =  // NOLINTNEXTLINE(cppcoreguidelines-slicing): the layers are all that is wanted
        lighting::compose(f, contextOf(in, settings), settings, seen.images, {base, diffuse, specular}, false);
    light.direct = seen.images.direct;
    light = withCoats(f, in, settings, seen, light);
    const gpu::Image opaque = light.lit;
    light = withBlended(f, blended.behindGlass, light);
    light = throughGlass(f, in, settings, seen, light, opaque).light;
    return withBlended(f, blended.front, light);
}

ScreenImages renderReflection(gpu::PassList& f, DirectViewStore& own, const ViewInputs& in, const Settings& settings,
                              gpu::Image lampShadowMap) {
    ViewImages images = directView(f, own, in, settings, lampShadowMap, ViewHistory::none);
    images.ambientOcclusion = lighting::ambientOcclusion(f, nullptr, contextOf(in, settings), settings, images);
    TracedView seen = tracedView(f, in, settings, images);
    const bool lit = settings.traceScreen.light != HitLight::direct;
    const gpu::Image direct = seen.images.direct;
    seen.screen.light = lit ? withProbeLight(f, in, settings, seen) : direct;
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, seen, lobeDiffuse);
    if (settings.diffuse.rays > 0) {
        seen.screen.light = direct;  // else the probes' light remains
    }
    const gpu::Image base = seen.screen.light;
    const BlendedSurfaces blended = lightForReflections(f, in, settings, diffuse, seen, ScreenReaders::others, false);
    if (lit && settings.planar.specular != 0) {
        seen.screen.light = reflectingLight(f, in, settings, seen, base, diffuse, blended).lit;
    } else {
        seen.screen.light =
            throughGlass(f, in, settings, seen, LightLayers{direct, {}, {}, seen.screen.light}).light.lit;
    }
    lighting::addPyramidOfPlanarView(f, settings, seen.images, seen.screen);
    const bool blurred = settings.planar.form == PlanarForm::camera && settings.planar.cameraBlur > 1.0F;
    if (seen.screen.lightMips || blurred) {
        lighting::prefilterOwnLight(f, seen.screen);
    }
    return seen.screen;
}

ScreenImages renderView(gpu::PassList& f, PlanarStore& own, const ViewInputs& in, const Settings& settings,
                        const Mirror& mirror, gpu::Image lampShadowMap) {
    const PlanarSettings& s = settings.planar;
    if (s.form != PlanarForm::duplicate) {
        return renderReflection(f, own.direct, mirrorViewInputs(in, mirror, s), planarSettings(settings),
                                lampShadowMap);
    }
    const uint32_t largestMap = f.context().limits().maxImageDimension2D;
    own.room = std::make_unique<MirroredScene>(mirroredScene(in, mirror, settings.shadow, largestMap));
    return renderReflection(f, own.direct, duplicateViewInputs(in, mirror, s, *own.room), duplicateSettings(settings),
                            {});
}

}  // namespace

std::vector<PlanarView> renderPlanarViews(gpu::PassList& f, std::vector<PlanarStore>& own, const ViewInputs& in,
                                          const Settings& settings, std::span<const Mirror> mirrors,
                                          gpu::Image lampShadowMap) {
    std::vector<PlanarView> views;
    own.resize(std::max(own.size(), mirrors.size()));
    for (const Mirror& mirror : mirrors) {
        const auto scope = f.scope("planar" + std::to_string(views.size()));
        views.push_back({renderView(f, own[views.size()], in, settings, mirror, lampShadowMap),
                         mirrorParams(mirror, settings.planar), settings.planar.form});
    }
    return views;
}

}  // namespace reflet
