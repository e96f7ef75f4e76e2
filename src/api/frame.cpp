// Records the stages of a view's frame.
#include "api/frame.h"

#include "api/calls.h"
#include "api/light_sources.h"
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

// This frame's and the last frame's picture. The first effect of a frame that reads or writes it swaps them.
gpu::History litOf(RefletView_T& view, Frame& frame) {
    if (!frame.lit.next) {
        frame.lit = view.store->lit.swap(view.recorder, lightFormat, frame.size, gpu::Resample::linear);
        frame.lit.valid = frame.lit.valid && view.composedLast;
    }
    frame.lit.valid = frame.lit.valid && !frame.composed;  // which overwrites the last picture
    return frame.lit;
}

LightBoundFrame boundFrame(const Frame& frame) {
    const ViewParams& v = frame.context.view;
    return {v.rest > 0, frame.change.light > 0.0F, v.exposureChange};
}

// How bright light of the host may be in this frame.
LightBound& boundOf(RefletView_T& view, Frame& frame) {
    if (!frame.bound) {
        frame.bound = lighting::boundLight(view.recorder, view.store->lightPeaks, frame.size, boundFrame(frame));
    }
    return *frame.bound;
}

gpu::Image hostRadiance(RefletView_T& view, const Settings& settings, LightBound& bound, gpu::Image given,
                        bool keepAlpha) {
    gpu::PassList& f = view.recorder;
    const gpu::Image light = lighting::importLight(
        f, given, {.maxRadiance = settings.input.maxRadiance, .limits = bound.limits, .keepAlpha = keepAlpha});
    lighting::measureLight(f, bound, light);
    return light;
}

// A host's radiance that has a history of its own.
gpu::Image radianceWithHistory(RefletView_T& view, const Frame& frame, const Settings& settings, LightBoundStore& own,
                               gpu::Image given, bool keepAlpha) {
    LightBound bound = lighting::boundLight(view.recorder, own, given.size, boundFrame(frame));
    return hostRadiance(view, settings, bound, given, keepAlpha);
}

// A picture that feeds no history.
gpu::Image pictureOf(RefletView_T& view, const Settings& settings, gpu::Image given) {
    return lighting::importLight(view.recorder, given, {.maxRadiance = settings.input.maxRadiance});
}

// Then the sum is bounded, too: otherwise the lobes bring no more than the bounded light, and what the environment has
// shown for long, such as a sun in mirrors, may be as bright as it is.
bool isEnvironmentNew(const ViewStore& own) {
    constexpr uint32_t frames = 8;
    return own.environmentRests < frames;
}

// Imports what rays find, and the screen as they see it.
ScreenImages screenForLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                           const LobeInputsOfHost& in) {
    gpu::PassList& f = view.recorder;
    noteEnvironment(view, lobe, in.environment);
    frame.context.environment = environmentLight(view, in.environment);
    frame.context.environment.params.factor *= frame.preExposure;
    const lighting::ViewContext& context = contextOf(view, frame);
    f.release(frame.light);  // of the other lobe
    frame.light = hostRadiance(view, settings, boundOf(view, frame), in.light, false);
    return lighting::lightAtHits(f, context, settings, lobe,
                                 lighting::screenOf(f, context, settings, frame, frame.light, litOf(view, frame)),
                                 frame.diffuse ? &*frame.diffuse : nullptr);
}

// The picture so far, with this radiance or what came of the last effect.
lighting::Light lightWith(const Frame& frame, gpu::Image radiance) {
    lighting::Light light = lighting::lightOf(frame, radiance);
    light.antialiased = frame.antialiased;
    light.unfiltered = frame.composed;
    return light;
}

// Only what has been composited is known to show reflections.
lighting::Reflecting reflectingOf(const Frame& frame) {
    const bool reflects = frame.specular && frame.composed;
    return {frame, reflects ? &*frame.specular : nullptr, frame.composed};
}

// The last picture of this frame before depth of field and motion blur.
gpu::Image pictureSoFar(const Frame& frame) {
    const gpu::Image radiance = frame.antialiased ? frame.antialiased : frame.composed;
    if (!radiance) {
        failArgument("color: is NULL, and neither refletTemporal nor refletComposite has run in this frame");
    }
    return radiance;
}

// Whether histories may still have samples of frames of another size.
bool mixesSizes(const RefletView_T& view) {
    constexpr uint32_t longest = 32;  // temporal.frames by default
    return view.steadyFrames < longest;
}

void keepLobe(gpu::PassList& f, const std::optional<LobeLight>& lobe) {
    if (!lobe) {
        return;
    }
    const GBuffer& g = lobe->from.g;
    // With these the composite brings a coarse lobe to full resolution, and antialiasing follows reflected images.
    for (const gpu::Image& image :
         {g.depth, g.normal, lobe->radiance, lobe->source, lobe->directional, lobe->imageMotion}) {
        f.keep(image);
    }
}

}  // namespace

const lighting::ViewContext& contextOf(RefletView_T& view, Frame& frame) {
    if (!frame.context.ggxTable) {
        frame.context.ggxTable = lighting::ggxTable(view.recorder, view.store->ggxTable);
        frame.context.blueNoise = blueNoiseOf(view);
    }
    return frame.context;
}

void finishCall(RefletView_T& view, const Frame& frame) {
    gpu::Recorder& f = view.recorder;
    const GBuffer& g = frame.g;
    for (const gpu::Image& image : {frame.shownDepth,
                                    frame.reactive,
                                    g.depth,
                                    g.normal,
                                    g.geometricNormal,
                                    g.baseColor,
                                    g.material,
                                    g.motion,
                                    g.reflectance,
                                    frame.backDepth,
                                    frame.pyramid,
                                    frame.light,
                                    frame.antialiased,
                                    frame.sharp,
                                    frame.defocused,
                                    frame.circleOfConfusion,
                                    frame.blurred,
                                    frame.velocityTiles,
                                    frame.sunVisibility,
                                    frame.lampVisibility,
                                    frame.ambientOcclusion,
                                    frame.exposure}) {
        f.keep(image);
    }
    for (uint32_t i = 0; i < frame.contactCount; ++i) {
        f.keep(frame.contacts[i]);
    }
    if (frame.display && !frame.display.state->external) {
        f.keep(frame.display);
    }
    f.keep(frame.bound ? frame.bound->limits : gpu::Image{});
    keepLobe(f, frame.diffuse);
    keepLobe(f, frame.specular);
    f.flush();
}

lighting::Light pictureToMap(RefletView_T& view, const Frame& frame, const Settings& settings, gpu::Image color) {
    const gpu::Image softened = frame.blurred ? frame.blurred : frame.defocused;
    if (color || !softened) {
        return lightWith(frame, color ? pictureOf(view, settings, color) : pictureSoFar(frame));
    }
    lighting::Light light = lightWith(frame, softened);
    light.sharp = frame.sharp;
    return light;
}

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
    const ShadowMap map{in.map, true, in.reversed, in.sun.count};
    const lighting::SunMaps maps{map,       lighting::shadowRange(f, settings.shadow, map), in.sun, in.toSun, in.slope,
                                 in.contact};
    frame.sunVisibility = lighting::sunShadow(f, &view.store->sunVisibility, context, settings, frame, maps).visibility;
    finishCall(view, frame);
    return frame.sunVisibility;
}

gpu::Image recordContactShadows(RefletView_T& view, Frame& frame, const Settings& settings, const vec4& light) {
    if (!(settings.contact.distance > 0.0F)) {
        failArgument("contact.distance: is 0, its default; set how far contact shadows reach, in metres");
    }
    if (frame.contactCount == frame.contacts.size()) {
        failArgument("light: is the {}th of this frame; at most {}", frame.contactCount + 1, frame.contacts.size());
    }
    const gpu::Image visibility =
        lighting::contactVisibility(view.recorder, frame.context, settings.contact, frame, light);
    frame.contacts[frame.contactCount++] = visibility;
    finishCall(view, frame);
    return visibility;
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

LobeLight recordLobe(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                     const LobeInputsOfHost& in) {
    const ScreenImages screen = screenForLobe(view, frame, settings, lobe, in);
    const lighting::HostLight own = hostLight(view, frame, settings, lobe, in.sources);
    const CacheUse cache(view, frame, settings, lobe == lobeDiffuse ? in.sources.cache : nullptr);
    const LobeLight traced = lighting::traceLobe(view.recorder, &view.store->of(lobe), frame.context, settings, lobe,
                                                 frame, screen, lighting::sourcesOf(own));
    (lobe == lobeDiffuse ? frame.diffuse : frame.specular) = traced;
    finishCall(view, frame);
    return traced;
}

MissedRays recordMissedRays(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                            const LobeInputsOfHost& in) {
    const ScreenImages screen = screenForLobe(view, frame, settings, lobe, in);
    const lighting::HostLight own = hostLight(view, frame, settings, lobe, in.sources);
    frame.pending = lighting::beginLobe(view.recorder, &view.store->of(lobe), frame.context, settings, lobe, frame,
                                        screen, lighting::sourcesOf(own));
    frame.pendingLight = {own.image, own.probes, {}};
    frame.pendingCache = lobe == lobeDiffuse ? in.sources.cache : nullptr;
    view.recorder.keep(own.image.light);
    finishCall(view, frame);
    return frame.pending->missed;
}

LobeLight recordAnswers(RefletView_T& view, Frame& frame, const Settings& settings) {
    const lighting::PendingLobe pending = *frame.pending;
    frame.pending.reset();
    const CacheUse cache(view, frame, settings, frame.pendingCache);
    frame.pendingCache.reset();
    const LobeLight answered = lighting::finishLobe(view.recorder, &view.store->of(pending.lobe), frame.context, frame,
                                                    pending, lighting::sourcesOf(frame.pendingLight).others);
    (pending.lobe == lobeDiffuse ? frame.diffuse : frame.specular) = answered;
    finishCall(view, frame);
    releaseMissed(view.recorder, pending.begun, pending.missed);
    view.recorder.release(frame.pendingLight.image.light);
    frame.pendingLight = {};
    return answered;
}

LobeLight recordDenoise(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe, gpu::Image noisy) {
    gpu::PassList& f = view.recorder;
    const gpu::Image radiance = radianceWithHistory(view, frame, settings, view.store->lobePeaks[lobe], noisy, true);
    const LobeLight clean =
        lighting::denoiseLobe(f, view.store->of(lobe), frame.context, settings, lobe, frame, radiance);
    (lobe == lobeDiffuse ? frame.diffuse : frame.specular) = clean;
    finishCall(view, frame);
    return clean;
}

lighting::Light recordComposite(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image light) {
    gpu::PassList& f = view.recorder;
    if (light) {
        frame.light = hostRadiance(view, settings, boundOf(view, frame), light, false);
    }
    if (!frame.light) {
        failArgument(
            "light: is NULL, and neither refletDiffuseGi nor refletReflections has been given any in this frame");
    }
    const lighting::ViewContext& context = contextOf(view, frame);
    const auto lobeOr = [&](const std::optional<LobeLight>& traced, uint32_t lobe) {
        return traced ? *traced : lighting::blackLobe(f, context, frame, lobe);
    };
    LightBound& bound = boundOf(view, frame);
    const lighting::LightParts parts{.direct = frame.light,
                                     .diffuse = lobeOr(frame.diffuse, lobeDiffuse),
                                     .specular = lobeOr(frame.specular, lobeSpecular),
                                     .limits = isEnvironmentNew(*view.store) ? bound.limits : gpu::Image{}};
    lighting::Light sum = lighting::compose(f, context, settings, frame, parts, true, litOf(view, frame).next);
    lighting::measureLight(f, bound, sum.lit);
    frame.composed = sum.lit;
    f.keep(sum.indirectDiffuse);
    f.keep(sum.indirectSpecular);
    finishCall(view, frame);
    return sum;
}

gpu::Image recordTemporal(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color) {
    gpu::PassList& f = view.recorder;
    const gpu::Image radiance =
        color ? radianceWithHistory(view, frame, settings, view.store->colorPeaks, color, false) : frame.composed;
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
    frame.antialiased = lighting::antialias(f, view.store->temporal, frame.context, settings, reflectingOf(frame),
                                            lightWith(frame, radiance),
                                            {size, frame.jitter, filtersSky ? &sky : nullptr, mixesSizes(view)})
                            .lit;
    finishCall(view, frame);
    return frame.antialiased;
}

gpu::Image recordDepthOfField(RefletView_T& view, Frame& frame, const Settings& settings, const Lens& lens,
                              gpu::Image color) {
    gpu::PassList& f = view.recorder;
    const gpu::Image radiance = color ? pictureOf(view, settings, color) : pictureSoFar(frame);
    const lighting::Light blurred = lighting::defocus(f, view.store->lens, contextOf(view, frame), settings, lens,
                                                      reflectingOf(frame), lightWith(frame, radiance));
    frame.sharp = radiance;
    frame.defocused = blurred.lit;
    frame.circleOfConfusion = blurred.circleOfConfusion;
    finishCall(view, frame);
    return blurred.lit;
}

gpu::Image recordMotionBlur(RefletView_T& view, Frame& frame, const Settings& settings, gpu::Image color) {
    const bool defocused = !color && frame.defocused;
    const gpu::Image radiance = color       ? pictureOf(view, settings, color)
                                : defocused ? frame.defocused
                                            : pictureSoFar(frame);
    const lighting::Light blurred =
        lighting::blurMotion(view.recorder, frame.context, settings, lightWith(frame, radiance));
    frame.sharp = defocused ? frame.sharp : radiance;
    frame.blurred = blurred.lit;
    frame.velocityTiles = blurred.motionTiles;
    finishCall(view, frame);
    return blurred.lit;
}

}  // namespace reflet::api
