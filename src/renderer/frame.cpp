// The frame, top to bottom: values in, values out. Start reading here.
//
// direct view (G-buffer → depth pyramid → sun and lamp visibility → direct light) → diffuse rays → source chain
// → layers of blended surfaces → planar views → specular rays → source chain → composite → clear coats → layers of
// glass → temporal antialiasing → depth of field → tone map
//
// renderFrame, at the end, does all of it; its parts are above it, those shared with other views in direct_view.cpp,
// and a lobe's rays in trace_lobe.cpp. There is no render graph: the `if`s in these files are all that culls passes.
#include "renderer/frame.h"

#include "effects/accumulate/accumulate.h"
#include "effects/exposure/exposure.h"
#include "effects/light_mips/light_mips.h"
#include "effects/lobe/trace_screen.h"
#include "effects/temporal/temporal.h"
#include "effects/tonemap/tonemap.h"
#include "gpu/context.h"
#include "renderer/gbuffer/draw_gbuffer.h"
#include "renderer/history.h"
#include "renderer/planar/planar_view.h"
#include "renderer/trace_lobe.h"

#include <algorithm>
#include <string>
#include <vector>

namespace reflet {

namespace {

constexpr VkFormat litFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

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

// The light that rays from blended surfaces, and then reflections, read at hits: direct light, or all light so far.
gpu::Image lightSoFar(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, const LobeLight& diffuse,
                      const ScreenImages& screen) {
    if (settings.traceScreen.light != HitLight::lit || settings.specular.rays == 0 || settings.diffuse.rays == 0) {
        return screen.light;
    }
    const auto scope = f.scope("specular");
    const LobeLight none = blackLobe(f, {screen.g, in.view}, settings.traceScreen.countSteps != 0);
    const gpu::Image soFar = f.image("lit_so_far", litFormat, screen.light.size);
    const CompositeInputs parts{screen.g, screen.light, diffuse, none, in.ggxTable, settings.materials.lambertOnly != 0,
                                false};
    return composite(f, parts, soFar, {in.view, settings.diffuse.gain}).lit;
}

// Lights the blended surfaces, and sets the light that reflections read at hits: all light so far, with blended
// surfaces in front; and its mips for cones. read: any rays read it.
BlendedSurfaces lightForReflections(gpu::Recorder& f, const ViewInputs& in, const Settings& settings,
                                    const LobeLight& diffuse, TracedView& seen, bool read, bool layers) {
    ScreenImages& screen = seen.screen;
    const SpecularSettings& s = settings.specular;
    screen.light = read ? lightSoFar(f, in, settings, diffuse, screen) : screen.light;
    const bool both = settings.blend.layers > 0 && showsBlended(in.draws, in.view) && showsGlass(in, settings);
    const gpu::Image glassDepth = both ? nearestGlass(f, in, settings, seen.images.g.depth) : gpu::Image{};
    const BlendedSurfaces blended = lightBlended(f, in, settings, seen, glassDepth, layers);
    if (!read || s.rays == 0) {
        return blended;
    }
    const auto scope = f.scope("specular");
    screen.light = withBlended(f, blended.behindGlass.lit, screen.light);
    screen.light = withBlended(f, blended.front.lit, screen.light);
    if (s.roughFallback == RoughFallback::mips && s.maxRoughness < 1.0F) {
        const bool previous = settings.traceScreen.light == HitLight::previous && screen.lit.valid;
        screen.lightMips = makeLightMips(f, previous ? screen.lit.previous : screen.light);
    }
    return blended;
}

// The light that reflections read at hits, with the glass in front of these: as the last frame has it, but of this one.
gpu::Image lightWithGlass(gpu::Recorder& f, const ViewInputs& in, const Settings& settings, const TracedView& seen) {
    const auto scope = f.scope("specular");
    const gpu::Image light = seen.screen.light;
    return throughGlass(f, in, settings, seen, {light, {{}, {}, light}}, {}, false).light.light.lit;
}

// Direct light with diffuse light from the probes, if there are any.
gpu::Image withProbeLight(gpu::Recorder& f, const ViewInputs& in, Settings settings, const TracedView& seen) {
    if (!in.probes) {
        return seen.images.direct;
    }
    const auto scope = f.scope("ambient");
    settings.traceScreen.enabled = 0;
    settings.traceScene.enabled = 0;
    settings.denoise.enabled = 0;
    settings.diffuse.rays = 1;
    settings.diffuse.distribution = RayDistribution::normal;
    settings.diffuse.adaptive = 0;
    settings.diffuse.reuse = 0;
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, seen, lobeDiffuse);
    const LobeLight none = blackLobe(f, {seen.images.g, in.view}, false);
    const gpu::Image sum = f.image("ambient", litFormat, seen.images.direct.size);
    const CompositeInputs parts{
        seen.images.g, seen.images.direct, diffuse, none, in.ggxTable, settings.materials.lambertOnly != 0, false};
    return composite(f, parts, sum, {in.view, settings.diffuse.gain}).lit;
}

// Renders a planar view, for use by reflections. It has no last frame: `previous` acts as `lit` there, and probes bring
// further bounces.
ScreenImages renderReflectionView(gpu::Recorder& f, FrameStore::Planar& own, const ViewInputs& in, Settings settings,
                                  gpu::Image lampShadowMap) {
    const bool lit = settings.traceScreen.light != HitLight::direct;
    settings.traceScreen.light = lit ? HitLight::lit : HitLight::direct;
    settings.traceScreen.countSteps = 0;
    settings.diffuse.rays = lit && settings.planar.diffuse != 0 ? settings.diffuse.rays : 0;
    settings.shadow.history = 0;  // the crop, and with it the pixels, moves with the camera
    settings.denoise.history = 0;
    const ViewImages images = directView(f, own.direct, in, settings, lampShadowMap);
    TracedView seen = tracedView(in, images);
    seen.screen.light = lit ? withProbeLight(f, in, settings, seen) : images.direct;
    const LobeLight diffuse = traceLobe(f, nullptr, in, settings, seen, lobeDiffuse);
    // Without diffuse rays, the probes' light remains.
    const gpu::Image base = settings.diffuse.rays > 0 ? images.direct : seen.screen.light;
    seen.screen.light = base;
    const BlendedSurfaces blended = lightForReflections(f, in, settings, diffuse, seen, true, false);
    gpu::Image light = seen.screen.light;
    const bool reflects = lit && settings.planar.specular != 0;
    if (reflects) {
        const LobeLight specular = traceLobe(f, nullptr, in, settings, seen, lobeSpecular);
        const gpu::Image all = f.image("lit", litFormat, images.direct.size);
        const CompositeInputs parts{images.g, base, diffuse, specular, in.ggxTable, settings.materials.lambertOnly != 0,
                                    false};
        light = composite(f, parts, all, {in.view, settings.diffuse.gain}).lit;
        if (showsCoats(in, settings)) {
            light = addCoats(f, in, settings, seen, {images.drawnDepth}, {images.direct, {{}, {}, light}}, {}, false)
                        .light.lit;
        }
    }
    if (showsGlass(in, settings)) {
        light = reflects ? withBlended(f, blended.behindGlass.lit, light) : light;
        light = throughGlass(f, in, settings, seen, {images.direct, {{}, {}, light}}, {}, false).light.light.lit;
    }
    seen.screen.light = reflects ? withBlended(f, blended.front.lit, light) : light;
    const bool blurred = settings.planar.form == PlanarForm::camera && settings.planar.cameraBlur > 1.0F;
    if (seen.screen.lightMips || blurred) {
        seen.screen.lightMips = makeLightMips(f, seen.screen.light);
    }
    return seen.screen;
}

ScreenImages renderPlanarView(gpu::Recorder& f, FrameStore::Planar& own, const FrameInputs& in,
                              const Settings& settings, const Mirror& mirror, gpu::Image lampShadowMap) {
    const PlanarSettings& s = settings.planar;
    if (s.form == PlanarForm::duplicate) {
        const uint32_t largestMap = f.context().limits().maxImageDimension2D;
        own.room = std::make_unique<MirroredScene>(mirroredScene(in, mirror, settings.shadow, largestMap));
        ViewInputs behind = duplicateViewInputs(in, mirror, s, *own.room);
        behind.traced = nullptr;  // these are not mirrored
        behind.probes = {};
        Settings there = settings;
        if (there.shadow.filter == ShadowFilter::traced) {
            there.shadow.filter = ShadowFilter::pcss;
        }
        return renderReflectionView(f, own, behind, there, {});
    }
    return renderReflectionView(f, own, mirrorViewInputs(in, mirror, s), settings, lampShadowMap);
}

std::vector<PlanarView> renderPlanarViews(gpu::Recorder& f, FrameStore& own, const FrameInputs& in,
                                          const Settings& settings, gpu::Image lampShadowMap) {
    std::vector<PlanarView> views;
    own.planar.resize(std::max(own.planar.size(), in.mirrors.size()));
    for (const Mirror& mirror : in.mirrors) {
        const auto scope = f.scope("planar" + std::to_string(views.size()));
        views.push_back({renderPlanarView(f, own.planar[views.size()], in, settings, mirror, lampShadowMap),
                         mirrorParams(mirror, settings.planar), settings.planar.form});
    }
    return views;
}

// Renders the live camera images shown by materials. Returns the lamps' shadow map if one was drawn.
gpu::Image renderLiveCameras(gpu::Recorder& f, std::vector<DirectViewStore>& own, const ViewInputs& in,
                             const Settings& settings, std::span<const LiveView> pictures) {
    own.resize(std::max(own.size(), pictures.size()));
    gpu::Image lampShadowMap;
    Settings direct = settings;
    direct.blend.layers = 0;
    direct.transmission.layers = 0;
    for (size_t i = 0; i < pictures.size(); ++i) {
        const auto scope = f.scope("live" + std::to_string(i));
        ViewInputs view = in;
        view.view = pictures[i].view;
        const ViewImages seen = directView(f, own[i], view, direct, lampShadowMap);
        lampShadowMap = seen.lampShadowMap;
        showLive(f, seen.direct, pictures[i].picture);
    }
    return lampShadowMap;
}

// Puts the background behind the radiance that is shown; coverage is accumulated as the radiance.
void showBackground(gpu::Recorder& f, FrameStore& own, const FrameInputs& in, const Settings& settings,
                    const BlendedSurfaces& blended, const NearestGlass& glass, FrameImages& out) {
    const gpu::Image depth = glass.depth ? depthWithGlass(f, glass, out.g.depth) : out.g.depth;
    const BackgroundImages shown =
        drawBackground(f, depth, out.direct, out.light.lit, *in.background.environment, in.view);
    out.direct = shown.direct;
    out.light.lit = shown.lit;
    if (!in.background.shown.needsCoverage()) {
        return;
    }
    const auto scope = f.scope("coverage");
    out.coverage = shown.coverage;
    const auto cover = [&](gpu::Image front) {
        if (front) {
            const gpu::Image over = f.image("coverage.blended", litFormat, shown.coverage.size);
            coverOver(f, front, out.coverage, over);
            out.coverage = over;
        }
    };
    cover(blended.behindGlass.lit);
    cover(blended.front.lit);
    if (settings.accumulate.enabled != 0) {
        out.coverage =
            accumulate(f, own.coverageMean, {out.coverage, {out.coverage, out.coverage, out.coverage}}, in.framesBefore)
                .direct;
    }
}

// Depth of field, of the radiance and of what surfaces cover of the picture.
void defocus(gpu::Recorder& f, FrameStore& own, const FrameInputs& in, const Settings& settings, FrameImages& out) {
    if (!blurs(in.lens, settings.dof)) {
        return;
    }
    const gpu::Image motion = historyUse(settings).temporal ? out.g.motion : gpu::Image{};
    const DofReflections reflections{out.g, out.specular, out.unfiltered, in.ggxTable,
                                     settings.materials.lambertOnly != 0};
    const auto blurred = [&](gpu::HistoryImage& store, gpu::Image picture) {
        return depthOfField(f, store, {picture, out.g.depth, motion, in.view, in.lens, settings.dof, reflections});
    };
    const DofImages light = blurred(own.circleOfConfusion, out.light.lit);
    out.light.lit = light.radiance;
    out.circleOfConfusion = light.coc;
    if (out.coverage) {
        const auto scope = f.scope("coverage");
        out.coverage = blurred(own.coverageCircleOfConfusion, out.coverage).radiance;
    }
}

}  // namespace

FrameImages renderFrame(gpu::Recorder& f, FrameStore& own, const FrameInputs& in, const Settings& asked) {
    Settings settings = asked;
    settings.denoise.radius *= in.view.size.y / static_cast<float>(in.outputSize.y);  // in pixels of the picture
    const gpu::Image lampShadowMap = renderLiveCameras(f, own.live, in, settings, in.live);
    TracedView seen = tracedView(in, directView(f, own.direct, in, settings, lampShadowMap));
    const gpu::History lit = own.history.swap(f, litFormat, seen.images.g.depth.size);
    seen.screen.lit = lit;
    FrameImages out{seen.images};
    out.view = in.view;
    out.probeAtlas = in.probes.atlas;
    out.diffuse = traceLobe(f, &own.diffuse, in, settings, seen, lobeDiffuse);
    const bool layers = settings.composite.layers != 0 || settings.accumulate.enabled != 0;
    const bool reused = settings.traceScene.enabled != 0 && settings.traceScene.reuseScreen != 0;
    const bool read = settings.traceScreen.enabled != 0 || reused;
    const BlendedSurfaces blended = lightForReflections(f, in, settings, out.diffuse, seen, read, layers);
    const bool glass = showsGlass(in, settings);
    if (glass && read && settings.specular.rays > 0 && settings.traceScreen.light != HitLight::previous) {
        seen.screen.light = lightWithGlass(f, in, settings, seen);
    }
    seen.mirrors = renderPlanarViews(f, own, in, settings, out.lampShadowMap);
    out.specular = traceLobe(f, &own.specular, in, settings, seen, lobeSpecular);

    const CompositeInputs parts{
        out.g, out.direct, out.diffuse, out.specular, in.ggxTable, settings.materials.lambertOnly != 0, layers};
    const auto image = [&](const char* name) { return f.image(name, litFormat, lit.next.size); };
    const gpu::Image behind = blended.front.lit ? image("lit_behind") : lit.next;
    const bool coats = showsCoats(in, settings);
    // Without rays, no frame reads the last one's light.
    const bool directAlone = out.diffuse.dark && out.specular.dark && !layers && !blended.front.lit &&
                             !in.background.environment && !glass && !coats;
    const gpu::Image withoutGlass = glass ? image("lit_without_glass") : behind;
    const gpu::Image withoutCoats = coats ? image("lit_without_coats") : withoutGlass;
    out.light = directAlone ? Composite{{}, {}, out.direct}
                            : composite(f, parts, withoutCoats, {in.view, settings.diffuse.gain});
    if (coats) {
        const LightLayers all =
            addCoats(f, in, settings, seen, {seen.images.drawnDepth}, {out.direct, out.light}, withoutGlass, layers);
        out.direct = all.direct;
        out.light = all.light;
    }
    NearestGlass nearestGlass;
    if (glass) {
        const LightLayers beyond = withBlended(f, blended.behindGlass, {out.direct, out.light});
        const LightThroughGlass all = throughGlass(f, in, settings, seen, beyond, behind, layers);
        out.direct = all.light.direct;
        out.light = all.light.light;
        nearestGlass = all.nearest;
    }
    gpu::Image sum = lit.next;
    if (in.background.environment) {
        if (blended.front.lit) {
            blendOver(f, blended.front.lit, behind, lit.next);  // rays of the next frame see the environment behind
            sum = image("lit_shown");
        }
        showBackground(f, own, in, settings, blended, nearestGlass, out);
    }
    const LightLayers shown = withBlended(f, blended.front, {out.direct, out.light}, sum);
    out.direct = shown.direct;
    out.light = shown.light;
    if (settings.accumulate.enabled != 0) {
        const LightLayers means = accumulate(f, own.accumulated, {out.direct, out.light}, in.framesBefore);
        out.direct = means.direct;
        out.light = means.light;
    }
    if (settings.composite.direct == 0) {
        out.light.lit = withoutDirect(f, out.light.lit, out.direct);
    }
    out.unfiltered = out.light.lit;
    if (historyUse(settings).temporal) {
        const GBuffer followed = glass ? motionWithGlass(f, nearestGlass, out.g) : out.g;
        const TemporalImages means =
            temporal(f, own.temporal, {followed, out.light.lit, out.coverage, in.view, in.outputSize, in.jitter},
                     settings.temporal);
        out.temporal = means.mean;
        out.light.lit = means.mean;
        out.coverage = means.coverage;
    }
    if (in.autoExposure) {
        const gpu::Image metered = out.light.lit.size == out.g.depth.size ? out.light.lit : out.unfiltered;
        out.exposure = measureExposure(f, own.exposure, metered, out.g.depth, in.elapsed, settings.tonemap.adaptation);
    }
    defocus(f, own, in, settings, out);
    const gpu::Image radiance = out.coverage ? straightRadiance(f, out.light.lit, out.coverage) : out.light.lit;
    out.display = tonemap(f, radiance, settings.tonemap, out.exposure);
    if (out.coverage) {
        out.display = overBackground(f, out.display, out.coverage, in.background.shown);
        out.transparent = in.background.shown.mode == Background::Mode::transparent;
    }
    return out;
}

}  // namespace reflet
