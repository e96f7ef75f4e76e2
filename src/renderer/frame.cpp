// The frame, top to bottom: values in, values out. Start reading here.
//
// renderFrame, at the end, does all of it. Its first half finds light: what the camera sees under direct light, then
// two lobes of rays, diffuse and specular, whose sources are in trace_lobe.cpp; mirrors are views of their own that
// specular rays look into (planar_views/). Its second half is a list of stages that each take the light of the picture
// and give it back with something added. How effects feed one another is in src/lighting.
#include "renderer/frame.h"

#include "lighting/indirect.h"
#include "renderer/coat/coat.h"
#include "renderer/glass/glass_layers.h"
#include "renderer/history.h"
#include "renderer/live/live_cameras.h"
#include "renderer/other_side/other_side.h"
#include "renderer/trace_lobe.h"
#include "renderer/view_light.h"

#include <cmath>

namespace reflet {

namespace {

Settings settingsOfFrame(const FrameInputs& in, Settings settings) {
    lighting::countRenderedPixels(settings, in.view.size.y, static_cast<float>(in.outputSize.y));
    lighting::fitHistories(settings, {in.view.rest, in.lightChange},
                           in.view.size.y / static_cast<float>(in.outputSize.y));
    settings.tonemap.exposure -= std::log2(in.view.preExposure);
    return settings;
}

// Whether the picture's layers are wanted, besides their sum.
bool keepsLayers(const Settings& settings) {
    return settings.composite.layers != 0 || settings.composite.direct == 0 || settings.accumulate.enabled != 0;
}

// The image of this frame's light, and the last one's. Without rays, no frame reads the last one's.
gpu::History litOf(gpu::PassList& f, FrameStore& own, const FrameInputs& in, const Settings& settings) {
    const bool traced = !in.draws.unlit && lighting::tracesRays(settings);
    return traced ? own.lit.swap(f, VK_FORMAT_R16G16B16A16_SFLOAT, uvec2(in.view.size)) : gpu::History{};
}

// What rays of the next frame read at hits: all surfaces, with the environment behind them. The composite has written
// it already where nothing is in front of it.
void keepForNextFrame(gpu::PassList& f, const gpu::History& lit, const lighting::Light& light) {
    if (lit.next && lit.next.state != light.lit.state) {
        f.copy(light.lit, lit.next);
    }
}

lighting::Light withMeans(gpu::PassList& f, FrameStore& own, const FrameInputs& in, const Settings& settings,
                          const lighting::Light& light) {
    return settings.accumulate.enabled != 0 ? lighting::accumulate(f, own.means, light, in.view.rest) : light;
}

// What is in front of the surfaces and the glass where the camera is in glass or water itself. Light of blended
// surfaces in it is not attenuated.
lighting::Light throughCameraMedium(gpu::PassList& f, const FrameInputs& in, const Settings& settings,
                                    const lighting::Light& light) {
    const bool drawn = in.medium && drawsGlass(in.draws, settings.transmission, settings.materials);
    return drawn ? throughMedium(f, *in.medium, in.view, light) : light;
}

// The environment, if it is what the camera sees behind everything and has detail.
const EnvironmentLight* skyOf(const FrameInputs& in) {
    const EnvironmentLight& sky = in.background.environment ? *in.background.environment : in.environment;
    return sky.texels.size.x > 1 ? &sky : nullptr;
}

// before: without the blended surfaces `front`, which `light` has. They move otherwise than what is behind them, so
// they have a history of their own.
lighting::Light withoutNoise(gpu::PassList& f, FrameStore& own, const FrameInputs& in, const Settings& settings,
                             const lighting::Reflecting& reflecting, const lighting::Light& light,
                             const lighting::Light& before, const BlendedSurfaces& blended) {
    if (!historyUse(settings).temporal) {
        return light;
    }
    const lighting::ViewContext context = contextOf(in, settings);
    const lighting::Antialiasing to{in.outputSize, in.jitter, skyOf(in)};
    if (!blended.front.lit || light.coverage || settings.composite.direct == 0) {
        return lighting::antialias(f, own.temporal, context, settings, reflecting, light, to);
    }
    lighting::Light out = lighting::antialias(f, own.temporal, context, settings, reflecting, before, to);
    const auto scope = f.scope("blend");
    lighting::Light front;
    front.lit = blended.front.lit;
    front.coverage = coverageOf(f, blended.front.lit);
    front.followedDepth = blended.depth;
    front.followedMotion = blended.motion;
    front = lighting::antialias(f, own.blended, context, settings, {reflecting.surfaces}, front, to);
    out.lit = blendAntialiased(f, front.lit, front.coverage, out.lit);
    out.direct = light.direct;  // with the blended surfaces, as `unfiltered`
    out.indirectDiffuse = light.indirectDiffuse;
    out.indirectSpecular = light.indirectSpecular;
    out.antialiased = out.lit;
    out.unfiltered = lighting::unfilteredOf(light);
    out.translucent = light.translucent;
    return out;
}

FrameImages imagesOf(const ViewImages& images, const FrameInputs& in, const lighting::Light& light) {
    FrameImages out{images};
    out.view = in.view;
    out.probeAtlas = in.probes.atlas;
    out.direct = light.direct;
    out.light = light;
    out.unfiltered = lighting::unfilteredOf(light);
    out.temporal = light.antialiased;
    out.coverage = light.coverage;
    out.circleOfConfusion = light.circleOfConfusion;
    out.velocityTiles = light.motionTiles;
    out.transparent = light.coverage && in.background.shown.mode == Background::Mode::transparent;
    return out;
}

}  // namespace

FrameImages renderFrame(gpu::PassList& f, FrameStore& own, const FrameInputs& in, const Settings& asked) {
    const Settings settings = settingsOfFrame(in, asked);
    const lighting::ViewContext context = contextOf(in, settings);
    const bool layers = keepsLayers(settings);

    // What the camera sees, under direct light.
    const gpu::Image lampShadowMap = renderLiveCameras(f, own.live, in, settings, in.live);
    ViewImages images = directView(f, own.direct, in, settings, lampShadowMap);
    images.ambientOcclusion = lighting::ambientOcclusion(f, &own.ambientOcclusion, context, settings, images);
    const gpu::History lit = litOf(f, own, in, settings);
    TracedView seen = tracedView(f, in, settings, images, lit);

    // Indirect light. Specular rays read the light so far where they hit the screen, and look into mirrors.
    const LobeLight diffuse = traceLobe(f, &own.diffuse, in, settings, seen, lobeDiffuse);
    const BlendedSurfaces blended = lightForReflections(f, in, settings, diffuse, seen, ScreenReaders::own, layers);
    addGlassForReflections(f, in, settings, seen);
    seen.mirrors = renderPlanarViews(f, own.planar, in, settings, in.mirrors, seen.images.lampShadowMap);
    const LobeLight specular = traceLobe(f, &own.specular, in, settings, seen, lobeSpecular);

    // The light of the surfaces, and of what is in front of them.
    lighting::Light light =
        lighting::compose(f, context, settings, seen.images,
                          {images.direct, diffuse, specular, images.fromEmitters, images.highlights}, layers, lit.next);
    light = withOtherSide(f, in, settings, seen, light);
    light = withCoats(f, in, settings, seen, light);
    const gpu::Image opaque = light.lit;
    light = withBlended(f, blended.behindGlass, light);
    light = throughGlass(f, in, settings, seen, light, opaque);
    lighting::Light before = throughCameraMedium(f, in, settings, light);
    const lighting::Light complete = withBlended(f, blended.front, light);  // as other viewers see it
    light = in.medium ? withBlended(f, blended.front, before) : complete;
    if (in.background.environment) {
        before = withBackground(f, in.background, in.view, before);
        light = withBlended(f, blended.front, before);
    }

    // The picture.
    light = withMeans(f, own, in, settings, light);
    light = settings.composite.direct != 0 ? light : lighting::withoutDirect(f, light);
    const lighting::Reflecting reflecting{seen.images, &specular, lighting::unfilteredOf(light)};
    light = withoutNoise(f, own, in, settings, reflecting, light, before, blended);
    keepForNextFrame(f, lit, complete);  // last: it may overwrite the light that has been antialiased
    gpu::Image exposure;
    if (in.autoExposure) {
        exposure = lighting::exposure(f, own.exposure, settings, seen.images, light, in.elapsed,
                                      std::log2(in.view.preExposure));
    }
    light = lighting::defocus(f, own.lens, context, settings, in.lens, reflecting, light);
    light = lighting::blurMotion(f, context, settings, light, in.cameraBefore ? &*in.cameraBefore : nullptr);
    FrameImages out = imagesOf(seen.images, in, light);
    out.diffuse = diffuse;
    out.specular = specular;
    out.exposure = exposure;
    out.display = displayOver(f, in.background, settings, light, exposure);
    return out;
}

}  // namespace reflet
