// Records the stages of a view's frame.
#include "api/frame.h"

#include "api/calls.h"
#include "noise/blue_noise.h"

namespace reflet::api {

namespace {

constexpr VkFormat lightFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

gpu::BufferView blueNoiseOf(RefletView_T& view) {
    ViewStore& own = *view.store;
    const gpu::BufferView buffer = own.blueNoise.get(view.recorder, blueNoise().size_bytes());
    if (!own.blueNoise.holds(view.recorder)) {
        view.recorder.update(buffer, std::as_bytes(blueNoise()));
    }
    return buffer;
}

// The frame's context with the tables that stages read, which are made for the first of them.
const lighting::ViewContext& contextOf(RefletView_T& view, Frame& frame) {
    if (!frame.context.ggxTable) {
        frame.context.ggxTable = lighting::ggxTable(view.recorder, view.store->ggxTable);
        frame.context.blueNoise = blueNoiseOf(view);
    }
    return frame.context;
}

// This frame's and the last frame's picture. The first effect of a frame that reads or writes it swaps them.
gpu::History litOf(RefletView_T& view, Frame& frame) {
    if (!frame.lit.next) {
        frame.lit = view.store->lit.swap(view.recorder, lightFormat, frame.size, gpu::Resample::linear);
        frame.lit.valid = frame.lit.valid && view.composedLast;
    }
    frame.lit.valid = frame.lit.valid && !frame.composed;  // which overwrites the last picture
    return frame.lit;
}

EnvironmentLight environmentLight(RefletView_T& view, const EnvironmentInputs& in) {
    gpu::PassList& f = view.recorder;
    EnvironmentImages& own = view.store->environment;
    const bool changed = own.generation != f.generation() || own.revision != in.revision || own.from != in.from;
    if (changed || f.isDiscarded(own.list)) {
        const gpu::Image texels = own.texels.storage(f, lightFormat, in.image ? in.image.size : uvec2(1));
        if (in.image) {
            const auto scope = f.scope("environment");
            lighting::importLight(f, in.image, false, texels);
        } else {  // the factor is its radiance
            f.clear(texels, {{1.0F, 1.0F, 1.0F, 1.0F}});
        }
        lighting::prefilterEnvironment(f, own.cube, texels, in.image ? in.image.size.x : 0);
        own.generation = f.generation();
        own.revision = in.revision;
        own.from = in.from;
        own.list = f.listNumber();
        f.promise();
    }
    return {own.texels.last(), own.cube.lobes.image(), own.cube.irradiance.image(), in.params};
}

LobeStore& storeOf(RefletView_T& view, uint32_t lobe) {
    return lobe == lobeDiffuse ? view.store->diffuse : view.store->specular;
}

// The picture so far, with this radiance or what came of the last effect.
lighting::Light lightWith(const Frame& frame, gpu::Image radiance) {
    lighting::Light light = lighting::lightOf(frame, radiance);
    light.antialiased = frame.antialiased;
    light.unfiltered = frame.composed;
    return light;
}

// The last picture of this frame before depth of field.
gpu::Image pictureSoFar(const Frame& frame) {
    const gpu::Image radiance = frame.antialiased ? frame.antialiased : frame.composed;
    if (!radiance) {
        failArgument("color: is NULL, and neither refletTemporal nor refletComposite has run in this frame");
    }
    return radiance;
}

// What the tone map is given: a host's picture, or the frame's.
lighting::Light pictureToMap(const Frame& frame, gpu::Image given) {
    if (given || !frame.defocused) {
        return lightWith(frame, given ? given : pictureSoFar(frame));
    }
    lighting::Light light = lightWith(frame, frame.defocused);
    light.sharp = frame.sharp;
    return light;
}

void keepLobe(gpu::PassList& f, const std::optional<LobeLight>& lobe) {
    if (!lobe) {
        return;
    }
    const GBuffer& g = lobe->from.g;
    // With these the composite brings a coarse lobe to full resolution.
    for (const gpu::Image& image : {g.depth, g.normal, lobe->radiance, lobe->source, lobe->directional}) {
        f.keep(image);
    }
}

// Records what a call has listed. What later calls and the host may read stays for the rest of the frame.
void finishCall(RefletView_T& view, const Frame& frame) {
    gpu::Recorder& f = view.recorder;
    const GBuffer& g = frame.g;
    for (const gpu::Image& image :
         {g.depth, g.normal, g.geometricNormal, g.baseColor, g.material, g.motion, g.reflectance, frame.backDepth,
          frame.pyramid, frame.light, frame.antialiased, frame.sharp, frame.defocused, frame.circleOfConfusion,
          frame.sunVisibility, frame.ambientOcclusion, frame.display}) {
        f.keep(image);
    }
    keepLobe(f, frame.diffuse);
    keepLobe(f, frame.specular);
    f.flush();
}

}  // namespace

gpu::FrameSizes sizesOf(const RefletView_T& view, uvec2 before) {
    return {before, view.renderSize, view.size, lighting::rescaleHistory};
}

void recordRescaling(RefletView_T& view) {
    gpu::Recorder& f = view.recorder;
    for (const VkFormat format : lighting::rescaledFormats()) {
        for (const gpu::Resample resample :
             {gpu::Resample::linear, gpu::Resample::nearest, gpu::Resample::depthInGreen}) {
            const gpu::Image to = f.image("rescaled", format, uvec2(1));
            lighting::rescaleHistory(f, f.placeholder(format), to, resample);
            f.keep(to);
        }
    }
    f.flush();
}

void recordImport(RefletView_T& view, Frame& frame, const HostSurfaces& host, const ImportParams& params) {
    static_cast<lighting::Surfaces&>(frame) = lighting::importSurfaces(view.recorder, host, params);
    finishCall(view, frame);
}

gpu::Image recordSunShadow(RefletView_T& view, Frame& frame, const Settings& settings, const SunInputs& in) {
    gpu::PassList& f = view.recorder;
    if (settings.shadow.filter == ShadowFilter::traced) {
        failArgument("shadow.filter: the library does not trace shadow rays; set hard, pcf or pcss");
    }
    const lighting::ViewContext& context = contextOf(view, frame);
    const gpu::Image map = lighting::importShadowMap(f, in.map, in.sun.count, in.reversed);
    const lighting::SunMaps maps{map,       lighting::shadowRange(f, settings.shadow, map), in.sun, in.toSun, in.slope,
                                 in.contact};
    frame.sunVisibility = lighting::sunShadow(f, &view.store->sunVisibility, context, settings, frame, maps).visibility;
    finishCall(view, frame);
    return frame.sunVisibility;
}

gpu::Image recordAmbientOcclusion(RefletView_T& view, Frame& frame, const Settings& settings) {
    if (settings.ao.method == AoMethod::none) {
        failArgument("ao.method: is none, its default; set horizon or bitmask");
    }
    frame.ambientOcclusion = lighting::ambientOcclusion(view.recorder, &view.store->ambientOcclusion,
                                                        contextOf(view, frame), settings, frame);
    finishCall(view, frame);
    return frame.ambientOcclusion;
}

LobeLight recordLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image light,
                     const EnvironmentInputs& environment) {
    gpu::PassList& f = view.recorder;
    frame.context.environment = environmentLight(view, environment);
    const lighting::ViewContext& context = contextOf(view, frame);
    f.release(frame.light);  // of the other lobe
    frame.light = lighting::importLight(f, light);
    const ScreenImages screen = lighting::lightAtHits(
        f, context, settings, lobe, lighting::screenOf(f, context, settings, frame, frame.light, litOf(view, frame)),
        frame.diffuse ? &*frame.diffuse : nullptr);
    const LobeLight traced = lighting::traceLobe(f, &storeOf(view, lobe), context, settings, lobe, frame, screen, {});
    (lobe == lobeDiffuse ? frame.diffuse : frame.specular) = traced;
    finishCall(view, frame);
    return traced;
}

LobeLight recordDenoise(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image noisy) {
    gpu::PassList& f = view.recorder;
    const LobeLight clean = lighting::denoiseLobe(f, storeOf(view, lobe), frame.context, settings, lobe, frame, noisy);
    (lobe == lobeDiffuse ? frame.diffuse : frame.specular) = clean;
    finishCall(view, frame);
    return clean;
}

lighting::Light recordComposite(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image light) {
    gpu::PassList& f = view.recorder;
    if (light) {
        frame.light = lighting::importLight(f, light);
    }
    if (!frame.light) {
        failArgument(
            "light: is NULL, and neither refletDiffuseGi nor refletReflections has been given any in this frame");
    }
    const lighting::ViewContext& context = contextOf(view, frame);
    const auto lobeOr = [&](const std::optional<LobeLight>& traced, uint32_t lobe) {
        return traced ? *traced : lighting::blackLobe(f, context, frame, lobe);
    };
    const lighting::LightParts parts{frame.light, lobeOr(frame.diffuse, lobeDiffuse),
                                     lobeOr(frame.specular, lobeSpecular)};
    const lighting::Light sum = lighting::compose(f, context, settings, frame, parts, true, litOf(view, frame).next);
    frame.composed = sum.lit;
    f.keep(sum.indirectDiffuse);
    f.keep(sum.indirectSpecular);
    finishCall(view, frame);
    return sum;
}

gpu::Image recordTemporal(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color) {
    gpu::PassList& f = view.recorder;
    const gpu::Image radiance = color ? lighting::importLight(f, color) : frame.composed;
    if (!radiance) {
        failArgument("color: is NULL, and refletComposite has not run in this frame");
    }
    const uvec2 size = outputSizeOf(view);
    if (glm::any(glm::lessThan(size, frame.size))) {
        failArgument("view: its output size, {}x{}, is smaller than the frame's, {}x{} (refletSetOutputSize)", size.x,
                     size.y, frame.size.x, frame.size.y);
    }
    const EnvironmentLight& sky = frame.context.environment;
    const bool filtersSky = frame.showsEnvironment && sky.texels && sky.texels.size.x > 1;
    frame.antialiased =
        lighting::antialias(f, view.store->temporal, frame.context, settings, lightWith(frame, radiance),
                            {size, frame.jitter, filtersSky ? &sky : nullptr})
            .lit;
    finishCall(view, frame);
    return frame.antialiased;
}

gpu::Image recordDepthOfField(RefletView_T& view, Frame& frame, const Settings& settings, const Lens& lens,
                              gpu::Image color) {
    gpu::PassList& f = view.recorder;
    const gpu::Image radiance = color ? lighting::importLight(f, color) : pictureSoFar(frame);
    const LobeLight* const specular = frame.specular && frame.composed ? &*frame.specular : nullptr;
    const lighting::Light blurred = lighting::defocus(f, view.store->lens, contextOf(view, frame), settings, lens,
                                                      frame, lightWith(frame, radiance), specular);
    frame.sharp = radiance;
    frame.defocused = blurred.lit;
    frame.circleOfConfusion = blurred.circleOfConfusion;
    finishCall(view, frame);
    return blurred.lit;
}

gpu::Image recordToneMap(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color, bool automatic) {
    gpu::PassList& f = view.recorder;
    const lighting::Light light = pictureToMap(frame, color ? lighting::importLight(f, color) : gpu::Image{});
    gpu::Image exposure;
    if (automatic) {
        if (!lighting::canMeter(light, frame)) {
            failArgument(
                "autoExposure: needs a picture of the view's size; color is larger, and refletComposite has not run");
        }
        exposure = lighting::exposure(f, view.store->exposure, settings, frame, light, frame.elapsed);
    }
    frame.display = lighting::display(f, settings, light.lit, exposure);
    finishCall(view, frame);
    return frame.display;
}

}  // namespace reflet::api
