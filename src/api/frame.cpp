// Records the effects of a view's frame.
#include "api/frame.h"

#include "api/calls.h"
#include "effects/light_mips/light_mips.h"
#include "effects/lobe/trace_screen.h"
#include "effects/pyramid/pyramid.h"
#include "noise/blue_noise.h"

#include <algorithm>
#include <bit>

namespace reflet::api {

namespace {

// Settings count pixels of the output.
DenoiseSettings denoiseSettings(const RefletView_T& view, const Settings& settings) {
    DenoiseSettings denoise = settings.denoise;
    denoise.radius *= static_cast<float>(view.size.y) / static_cast<float>(outputSizeOf(view).y);
    return denoise;
}

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

gpu::BufferView blueNoiseOf(RefletView_T& view) {
    ViewImages& own = *view.images;
    const gpu::BufferView buffer = own.blueNoise.get(view.recorder, blueNoise().size_bytes());
    if (!own.blueNoise.holds(view.recorder)) {
        view.recorder.update(buffer, std::as_bytes(blueNoise()));
    }
    return buffer;
}

gpu::Image pyramidOf(RefletView_T& view, Frame& frame) {
    if (!frame.pyramid) {
        frame.pyramid = makePyramid(view.recorder, frame.g.depth, frame.backDepth);
    }
    return frame.pyramid;
}

// This frame's and the last frame's picture. The first effect of a frame that reads or writes it swaps them.
gpu::History litOf(RefletView_T& view, Frame& frame) {
    if (!frame.lit.next) {
        frame.lit = view.images->lit.swap(view.recorder, lightFormat, view.size);
        frame.lit.valid = frame.lit.valid && view.composedLast;
    }
    return frame.lit;
}

uint32_t cubeSideFor(uvec2 size) {
    return std::clamp(std::bit_ceil(size.x / 4), 64U, 256U);
}

EnvironmentLight environmentLight(RefletView_T& view, const EnvironmentInputs& in) {
    gpu::Recorder& f = view.recorder;
    EnvironmentImages& own = view.images->environment;
    const bool changed = own.generation != f.generation() || own.revision != in.revision || own.from != in.from;
    if (changed || f.isDiscarded(own.list)) {
        const auto scope = f.scope("environment");
        const gpu::Image texels = own.texels.storage(f, lightFormat, in.image ? in.image.size : uvec2(1));
        if (in.image) {
            importLight(f, in.image, false, texels);
        } else {  // the factor is its radiance
            f.clear(texels, {{1.0F, 1.0F, 1.0F, 1.0F}});
        }
        const uint32_t side = in.image ? cubeSideFor(in.image.size) : 1;
        if (own.cube.sharp.info().size.x != side) {
            own.cube = CubeMap(f.context(), side, 1, "environment");
        }
        prefilterEnvironment(f, own.cube, texels);
        own.generation = f.generation();
        own.revision = in.revision;
        own.from = in.from;
        own.list = f.listNumber();
        f.promise();
    }
    return {own.texels.last(), own.cube.lobes.image(), own.cube.irradiance.image(), in.params};
}

TraceScreenSettings traceSettings(const Settings& settings, const Frame& frame) {
    TraceScreenSettings trace = settings.traceScreen;
    if (!frame.backDepth && trace.thicknessMode == ThicknessMode::secondLayer) {
        trace.thicknessMode = ThicknessMode::constant;
    }
    trace.countSteps = 0;
    return trace;
}

// The light that rays of a lobe read at hits: what the host gave, for reflections with the diffuse lobe's, if that ran.
gpu::Image lightAtHits(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe) {
    if (lobe == lobeDiffuse || settings.traceScreen.light != HitLight::lit || !frame.diffuse || frame.diffuse->dark) {
        return frame.light;
    }
    gpu::Recorder& f = view.recorder;
    const auto scope = f.scope("specular");
    const LobeLight none = blackLobe(f, {frame.g, frame.view}, false);
    const gpu::Image sum = f.image("lit_so_far", lightFormat, view.size);
    const CompositeInputs parts{frame.g, frame.light, *frame.diffuse, none, ggxTable(f, view.images->ggxTable),
                                false,   false};
    return composite(f, parts, sum, {frame.view, settings.diffuse.gain}).lit;
}

// The last picture of this frame before depth of field.
gpu::Image pictureSoFar(const Frame& frame) {
    const gpu::Image radiance = frame.antialiased ? frame.antialiased : frame.composed;
    if (!radiance) {
        failArgument("color: is NULL, and neither refletTemporal nor refletComposite has run in this frame");
    }
    return radiance;
}

void keepLobe(gpu::Recorder& f, const std::optional<LobeLight>& lobe) {
    if (!lobe) {
        return;
    }
    const GBuffer& g = lobe->from.g;
    for (const gpu::Image& image : {g.depth, g.normal, g.geometricNormal, g.baseColor, g.material, g.motion,
                                    g.reflectance, g.layers, lobe->radiance, lobe->source, lobe->directional}) {
        f.keep(image);
    }
}

// Records what a call has listed. What later calls and the host may read stays for the rest of the frame.
void finishCall(RefletView_T& view, const Frame& frame) {
    gpu::Recorder& f = view.recorder;
    const GBuffer& g = frame.g;
    for (const gpu::Image& image :
         {g.depth, g.normal, g.geometricNormal, g.baseColor, g.material, g.motion, g.reflectance, frame.backDepth,
          frame.pyramid, frame.light, frame.antialiased, frame.defocused, frame.circleOfConfusion, frame.sunVisibility,
          frame.ambientOcclusion, frame.display}) {
        f.keep(image);
    }
    keepLobe(f, frame.diffuse);
    keepLobe(f, frame.specular);
    f.flush();
}

}  // namespace

void recordImport(RefletView_T& view, Frame& frame, const HostSurfaces& host, const ImportParams& params) {
    const ImportedSurfaces surfaces = importSurfaces(view.recorder, host, params);
    frame.g = surfaces.g;
    frame.backDepth = surfaces.backDepth;
    finishCall(view, frame);
}

gpu::Image recordSunShadow(RefletView_T& view, Frame& frame, const Settings& settings, const SunInputs& in) {
    gpu::Recorder& f = view.recorder;
    ShadowSettings shadow = settings.shadow;
    shadow.resolution = in.map.size.x;
    shadow.earlyOut = 0;
    if (shadow.filter == ShadowFilter::traced) {
        failArgument("shadow.filter: the library does not trace shadow rays; set hard, pcf or pcss");
    }
    const gpu::Image map = importShadowMap(f, in.map, in.sun.count, in.reversed);
    const SunVisibility seen =
        sunVisibility(f, frame.g, {map, {}, blueNoiseOf(view)}, {frame.view, in.sun, shadow, in.slope});
    gpu::Image visible = seen.visibility;
    if (shadow.denoise != 0 && seen.penumbra) {
        visible = denoiseShadow(f, &view.images->sunVisibility, frame.g, visible, seen.penumbra,
                                {frame.view, in.toSun, shadow.history, shadow.samples, 0});
    }
    if (in.contact && settings.contact.distance > 0.0F) {
        visible = contactShadow(f, frame.g, pyramidOf(view, frame), visible, {frame.view, settings.contact, in.toSun});
    }
    frame.sunVisibility = visible;
    finishCall(view, frame);
    return visible;
}

gpu::Image recordAmbientOcclusion(RefletView_T& view, Frame& frame, const Settings& settings) {
    gpu::Recorder& f = view.recorder;
    if (settings.ao.method == AoMethod::none) {
        failArgument("ao.method: is none, its default; set horizon or bitmask");
    }
    frame.ambientOcclusion = ambientOcclusion(f, &view.images->ambientOcclusion,
                                              {.g = frame.g,
                                               .view = frame.view,
                                               .backDepth = frame.backDepth,
                                               .settings = settings.ao,
                                               .denoise = denoiseSettings(view, settings),
                                               .ggxTable = ggxTable(f, view.images->ggxTable),
                                               .blueNoise = blueNoiseOf(view)});
    finishCall(view, frame);
    return frame.ambientOcclusion;
}

LobeLight recordLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image light,
                     const EnvironmentInputs& environment) {
    gpu::Recorder& f = view.recorder;
    const bool diffuse = lobe == lobeDiffuse;
    LobeStore& own = diffuse ? view.images->diffuse : view.images->specular;
    frame.light = importLight(f, light);
    const TraceScreenSettings trace = traceSettings(settings, frame);
    ScreenImages screen{
        frame.g, frame.view, frame.backDepth, {}, lightAtHits(view, frame, settings, lobe), litOf(view, frame), {}};
    const bool hiz = trace.method == TraceMethod::hiz;
    screen.pyramid = trace.enabled != 0 && hiz ? pyramidOf(view, frame) : gpu::Image{};
    const SpecularSettings& s = settings.specular;
    if (!diffuse && s.roughFallback == RoughFallback::mips && s.maxRoughness < 1.0F) {
        const bool previous = trace.light == HitLight::previous && screen.lit.valid;
        screen.lightMips = makeLightMips(f, previous ? screen.lit.previous : screen.light);
    }
    const float longest = diffuse ? settings.diffuse.maxDistance : trace.maxDistance;
    const bool exact = hiz || trace.method == TraceMethod::exhaustive;
    const EnvironmentLight around = environmentLight(view, environment);
    const LobeLight traced =
        traceLobe(f, &own,
                  {.lobe = lobe,
                   .g = frame.g,
                   .view = frame.view,
                   .settings = diffuse ? lobeSettings(settings.diffuse) : lobeSettings(settings.specular),
                   .diffuse = settings.diffuse,
                   .specular = settings.specular,
                   .denoise = denoiseSettings(view, settings),
                   .environmentSettings = settings.environment,
                   .environment = around,
                   .ggxTable = ggxTable(f, view.images->ggxTable),
                   .blueNoise = blueNoiseOf(view),
                   .screen = {trace.enabled != 0 ? &screen : nullptr, trace, longest},
                   .sources = {},
                   .ambientOcclusion = frame.ambientOcclusion,
                   .lit = screen.lit,
                   .randomTracing = trace.enabled != 0 && trace.jitter != 0 && !exact,
                   .coneShare = trace.enabled != 0 ? 0.1F : 0.0F});
    (diffuse ? frame.diffuse : frame.specular) = traced;
    finishCall(view, frame);
    return traced;
}

LobeLight recordDenoise(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image noisy) {
    gpu::Recorder& f = view.recorder;
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    LobeStore& own = diffuse ? view.images->diffuse : view.images->specular;
    LobeLight light;
    light.from = {frame.g, frame.view, 1};
    light.radiance = importLight(f, noisy, true);
    light.source = light.radiance;
    const LobeLight clean = denoise(f, &own.denoise, light, lobe, frame.view, denoiseSettings(view, settings));
    (diffuse ? frame.diffuse : frame.specular) = clean;
    finishCall(view, frame);
    return clean;
}

Composite recordComposite(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image light) {
    gpu::Recorder& f = view.recorder;
    if (light) {
        frame.light = importLight(f, light);
    }
    if (!frame.light) {
        failArgument(
            "light: is NULL, and neither refletDiffuseGi nor refletReflections has been given any in this frame");
    }
    const auto lobeOr = [&](const std::optional<LobeLight>& lobe, const char* name) {
        if (lobe) {
            return *lobe;
        }
        const auto scope = f.scope(name);
        return blackLobe(f, {frame.g, frame.view}, false);
    };
    const LobeLight diffuse = lobeOr(frame.diffuse, "diffuse");
    const LobeLight specular = lobeOr(frame.specular, "specular");
    const CompositeInputs parts{frame.g, frame.light, diffuse, specular, ggxTable(f, view.images->ggxTable),
                                false,   true};
    const Composite sum = composite(f, parts, litOf(view, frame).next, {frame.view, settings.diffuse.gain});
    frame.composed = sum.lit;
    f.keep(sum.indirectDiffuse);
    f.keep(sum.indirectSpecular);
    finishCall(view, frame);
    return sum;
}

gpu::Image recordTemporal(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color) {
    gpu::Recorder& f = view.recorder;
    const gpu::Image radiance = color ? importLight(f, color) : frame.composed;
    if (!radiance) {
        failArgument("color: is NULL, and refletComposite has not run in this frame");
    }
    const uvec2 size = outputSizeOf(view);
    if (glm::any(glm::lessThan(size, view.size))) {
        failArgument("view: its output size, {}x{}, is smaller than its size, {}x{} (refletSetOutputSize)", size.x,
                     size.y, view.size.x, view.size.y);
    }
    const TemporalInputs in{frame.g, radiance, {}, frame.view, size, frame.jitter};
    frame.antialiased = temporal(f, view.images->temporal, in, settings.temporal).mean;
    finishCall(view, frame);
    return frame.antialiased;
}

gpu::Image recordDepthOfField(RefletView_T& view, Frame& frame, const Settings& settings, const Lens& lens,
                              gpu::Image color) {
    gpu::Recorder& f = view.recorder;
    const gpu::Image radiance = color ? importLight(f, color) : pictureSoFar(frame);
    DofInputs in{radiance,   frame.g.depth, frame.antialiased ? frame.g.motion : gpu::Image{},
                 frame.view, lens,          settings.dof};
    if (frame.specular && frame.composed) {
        in.reflections = {frame.g, *frame.specular, frame.composed, ggxTable(f, view.images->ggxTable)};
    }
    const DofImages blurred = depthOfField(f, view.images->circleOfConfusion, in);
    frame.defocused = blurred.radiance;
    frame.circleOfConfusion = blurred.coc;
    finishCall(view, frame);
    return blurred.radiance;
}

gpu::Image recordToneMap(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color, bool automatic) {
    gpu::Recorder& f = view.recorder;
    const gpu::Image given = color ? importLight(f, color) : frame.defocused;
    const gpu::Image radiance = given ? given : pictureSoFar(frame);
    gpu::Image exposure;
    if (automatic) {
        const gpu::Image metered = radiance.size == frame.g.depth.size ? radiance : frame.composed;
        if (!metered) {
            failArgument(
                "autoExposure: needs a picture of the view's size; color is larger, and refletComposite has not run");
        }
        exposure = measureExposure(f, view.images->exposure, metered, frame.g.depth, frame.elapsed,
                                   settings.tonemap.adaptation);
    }
    frame.display = tonemap(f, radiance, settings.tonemap, exposure);
    finishCall(view, frame);
    return frame.display;
}

}  // namespace reflet::api
