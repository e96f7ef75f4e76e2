// Pipelines before the first frame.
#include "api/calls.h"
#include "api/camera.h"
#include "api/frame.h"
#include "api/light_sources.h"
#include "api/live.h"

#include <algorithm>
#include <utility>

namespace reflet::api {

namespace {

constexpr uint32_t allEffects = 2 * REFLET_EFFECT_MOTION_BLUR - 1;

// Stand-ins for the host's images: passes that are only prepared never read them.
class StandIns {
public:
    explicit StandIns(RefletView_T& view) : view_(view) {}

    gpu::Image make(uvec2 size) {
        gpu::ImageState& state = view_.hostImages.emplace_back();
        state.external = true;
        state.layout = VK_IMAGE_LAYOUT_GENERAL;
        return {&state, -1, VK_FORMAT_R16G16B16A16_SFLOAT, size, 1, 1};
    }
    gpu::Image makeIfGiven(const RefletImage& image) {
        return image.image != VK_NULL_HANDLE ? make(view_.renderSize) : gpu::Image{};
    }

private:
    RefletView_T& view_;
};

// Where a lobe's light comes from.
enum class LobeFrom : uint8_t { nowhere, rays, host, answeredRays };

// A frame of some of the effects that a host has asked for.
struct FrameKind {
    uint32_t effects = 0;
    LobeFrom diffuse = LobeFrom::nowhere;
    LobeFrom specular = LobeFrom::nowhere;
    bool skyMoves = false;  // the picture shows an environment, and the camera turns
};

std::vector<LobeFrom> choicesOf(uint32_t effects, RefletEffect rays, RefletEffect missed) {
    std::vector<LobeFrom> choices{LobeFrom::nowhere};
    if ((effects & rays) != 0) {
        choices.push_back(LobeFrom::rays);
    }
    if ((effects & REFLET_EFFECT_DENOISE) != 0) {
        choices.push_back(LobeFrom::host);
    }
    if ((effects & missed) != 0) {
        choices.push_back(LobeFrom::answeredRays);
    }
    return choices;
}

FrameKind wholeFrame(uint32_t effects) {
    const auto from = [&](RefletEffect rays, RefletEffect missed) {
        const auto choices = choicesOf(effects, rays, missed);
        return choices.size() > 1 ? choices[1] : LobeFrom::nowhere;
    };
    return {effects, from(REFLET_EFFECT_DIFFUSE_GI, REFLET_EFFECT_MISSED_DIFFUSE_RAYS),
            from(REFLET_EFFECT_REFLECTIONS, REFLET_EFFECT_MISSED_REFLECTION_RAYS)};
}

// Frames whose passes are all that frames of any of these effects can have: each effect may run or not. Effects that
// change each other's passes are varied together.
std::vector<FrameKind> frameKinds(const RefletPrepareInfo& info) {
    const uint32_t all = info.effects;
    std::vector<FrameKind> kinds;
    for (const LobeFrom diffuse : choicesOf(all, REFLET_EFFECT_DIFFUSE_GI, REFLET_EFFECT_MISSED_DIFFUSE_RAYS)) {
        for (const LobeFrom specular :
             choicesOf(all, REFLET_EFFECT_REFLECTIONS, REFLET_EFFECT_MISSED_REFLECTION_RAYS)) {
            kinds.push_back({all, diffuse, specular});
            kinds.push_back({all & ~REFLET_EFFECT_TEMPORAL, diffuse, specular});
        }
    }
    for (const uint32_t without :
         {uint32_t(REFLET_EFFECT_AMBIENT_OCCLUSION), uint32_t(REFLET_EFFECT_CONTACT_SHADOWS),
          uint32_t(REFLET_EFFECT_COMPOSITE), uint32_t(REFLET_EFFECT_COMPOSITE | REFLET_EFFECT_TEMPORAL)}) {
        if ((all & without) != 0) {
            FrameKind kind = wholeFrame(all);
            kind.effects &= ~without;
            kinds.push_back(kind);
        }
    }
    if (info.hasEnvironmentImage != 0) {
        kinds.push_back(wholeFrame(all));
        kinds.back().skyMoves = true;
    }
    return kinds;
}

void prepareSun(RefletView_T& view, Frame& frame, const Settings& settings, const RefletPrepareInfo& info,
                const FrameKind& kind, StandIns& standIns) {
    SunInputs sun;
    sun.map = standIns.make(uvec2(info.shadowMapSide > 0 ? info.shadowMapSide : 2048));
    sun.reversed = info.shadowDepthKind == REFLET_DEPTH_REVERSED;
    sun.sun.count = std::clamp(info.cascades, 1U, maxCascades);
    sun.contact = (kind.effects & REFLET_EFFECT_CONTACT_SHADOWS) != 0;
    recordSunShadow(view, frame, settings, sun);
}

// One 2D map and one cube map: their passes are all that lamps have.
void prepareLamps(RefletView_T& view, Frame& frame, const Settings& settings, const RefletPrepareInfo& info,
                  StandIns& standIns) {
    const uint32_t side = info.lampMapSide > 0 ? info.lampMapSide : 512;
    const uint32_t count = std::clamp((std::max(info.lampMapTiles, 7U) + 5) / 6, 2U, maxShadowedLamps);
    std::vector<lighting::HostLamp> lamps(count);
    for (lighting::HostLamp& lamp : lamps) {
        lamp.isCube = &lamp != lamps.data();
        lamp.map = standIns.make(uvec2(side));
        lamp.shadow.side = side;
        lamp.shadow.tiles = lamp.isCube ? cubeFaces : 1;
    }
    recordLampShadows(view, frame, settings, lamps);
}

// Probes, planar views and images as info.light will have them.
SourceInputs preparedSources(const RefletView_T& view, const RefletPrepareInfo& info, StandIns& standIns) {
    SourceInputs in;
    if (info.light == nullptr) {
        return in;
    }
    const RefletIndirectLight& light = *info.light;
    const auto given = [&](const RefletImage& image) { return image.image != VK_NULL_HANDLE; };
    in.specular = given(light.specularFallback) ? standIns.make(view.renderSize) : gpu::Image{};
    in.irradiance = given(light.irradiance) ? standIns.make(view.renderSize) : gpu::Image{};
    in.planarAfterScreen = light.planarViewsAfterScreen != 0;
    in.cache = light.radianceCache != nullptr ? std::make_shared<RefletRadianceCache_T>() : nullptr;
    in.planar.resize(light.planarViewCount);
    for (lighting::HostPlanarView& planar : in.planar) {
        planar.color = planar.depth = standIns.make(view.renderSize);
        planar.view.size = vec2(view.renderSize);
    }
    for (uint32_t i = 0; i < light.probeCount; ++i) {
        const RefletProbe probe = probeAt(light, i);
        HostProbe made{};
        made.radiance = standIns.make(uvec2(probe.radiance.width > 0 ? probe.radiance.width : 128));
        made.levels = std::max(probe.radianceLevels, 1U);
        made.distance = given(probe.distance) ? standIns.make(made.radiance.size) : gpu::Image{};
        made.irradiance = given(probe.irradiance) ? standIns.make(uvec2(16)) : gpu::Image{};
        if (probe.sphericalHarmonics != nullptr) {
            made.harmonics.emplace();
        }
        made.params.parallax = static_cast<uint32_t>(probe.parallax == REFLET_PARALLAX_DEPTH  ? ProbeParallax::depth
                                                     : probe.parallax == REFLET_PARALLAX_NONE ? ProbeParallax::none
                                                                                              : ProbeParallax::box);
        in.probes.push_back(made);
    }
    in.probeKey.push_back({});  // of no host
    return in;
}

void prepareLobes(RefletView_T& view, Frame& frame, const Settings& settings, const RefletPrepareInfo& info,
                  const FrameKind& kind, StandIns& standIns) {
    EnvironmentInputs environment;
    environment.image = info.hasEnvironmentImage != 0 ? standIns.make(uvec2(256)) : gpu::Image{};
    const gpu::Image color = standIns.make(view.renderSize);
    const SourceInputs sources = preparedSources(view, info, standIns);
    const LobeInputsOfHost in{color, environment, sources};
    for (const uint32_t lobe : {lobeDiffuse, lobeSpecular}) {
        const LobeFrom from = lobe == lobeDiffuse ? kind.diffuse : kind.specular;
        if (from == LobeFrom::rays) {
            recordLobe(view, frame, settings, lobe, in);
        } else if (from == LobeFrom::host) {
            recordDenoise(view, frame, settings, lobe, color);
        } else if (from == LobeFrom::answeredRays) {
            recordMissedRays(view, frame, settings, lobe, in);
            recordAnswers(view, frame, settings);
        }
    }
}

void prepareToneMap(RefletView_T& view, Frame& frame, const Settings& settings, const RefletPrepareInfo& info,
                    DisplayInputs in, StandIns& standIns) {
    DisplayTarget target;
    if (info.toneMap != nullptr) {
        const RefletToneMapInfo& to = *info.toneMap;
        target = displayTarget(view, to);
        if (to.output != nullptr) {
            target.image = standIns.make(outputSizeOf(view));
            target.image.format = target.format;
        }
        in.exposure = to.exposure != nullptr && !in.automatic ? standIns.make(uvec2(1)) : gpu::Image{};
        in.target = &target;
    }
    recordToneMap(view, frame, settings, in);
}

// The first frame of a view, which has passes that later ones lack.
void prepareFrame(RefletView_T& view, const Settings& settings, const RefletPrepareInfo& info, const FrameKind& kind) {
    StandIns standIns(view);
    const auto asked = [&](RefletEffect effect) { return (kind.effects & effect) != 0; };
    Frame frame;
    frame.size = view.renderSize;
    frame.context.view.size = vec2(view.renderSize);
    frame.showsEnvironment = kind.skyMoves;
    frame.context.view.eye.w = kind.skyMoves ? 1.0F : 0.0F;
    frame.context.view.worldToClip[0][0] = kind.skyMoves ? 1.0F : 0.0F;  // other than the last frame's
    HostSurfaces surfaces = hostSurfaces(*info.gbuffer, [&](const RefletImage& i) { return standIns.makeIfGiven(i); });
    surfaces.depth = standIns.make(view.renderSize);
    surfaces.normal = standIns.make(view.renderSize);
    recordImport(view, frame, surfaces, {});
    if (asked(REFLET_EFFECT_SUN_SHADOW)) {
        prepareSun(view, frame, settings, info, kind, standIns);
    }
    if (asked(REFLET_EFFECT_LAMP_SHADOWS)) {
        prepareLamps(view, frame, settings, info, standIns);
    }
    if (asked(REFLET_EFFECT_CONTACT_SHADOWS) && settings.contact.distance > 0.0F) {
        recordContactShadows(view, frame, settings, vec4(0.0F, 1.0F, 0.0F, 0.0F));
    }
    if (asked(REFLET_EFFECT_AMBIENT_OCCLUSION)) {
        recordAmbientOcclusion(view, frame, settings);
    }
    prepareLobes(view, frame, settings, info, kind, standIns);
    // With a composite, what comes after it needs no picture of the host's.
    const bool composes = asked(REFLET_EFFECT_COMPOSITE);
    const auto pictureOr = [&](uvec2 size) { return composes ? gpu::Image{} : standIns.make(size); };
    if (composes) {
        recordComposite(view, frame, settings, frame.light ? gpu::Image{} : standIns.make(view.renderSize));
    }
    if (asked(REFLET_EFFECT_TEMPORAL)) {
        recordTemporal(view, frame, settings, pictureOr(view.renderSize));
    }
    if (asked(REFLET_EFFECT_DEPTH_OF_FIELD)) {
        for (const uint32_t blades : {0U, 6U}) {  // round apertures, and polygons
            recordDepthOfField(view, frame, settings, {.apertureRadius = 1.0F, .blades = blades},
                               pictureOr(outputSizeOf(view)));
        }
    }
    if (asked(REFLET_EFFECT_MOTION_BLUR)) {
        recordMotionBlur(view, frame, settings, pictureOr(outputSizeOf(view)));
    }
    if (asked(REFLET_EFFECT_TONE_MAP)) {
        const bool meters = info.autoExposure != 0 && (composes || outputSizeOf(view) == view.renderSize);
        prepareToneMap(view, frame, settings, info, {.color = pictureOr(outputSizeOf(view)), .automatic = meters},
                       standIns);
    }
    if (info.changesSize != 0) {
        recordRescaling(view);
    }
}

// changed: as soon as one of another size may have come before.
void prepareOnce(RefletView_T& view, const Settings& settings, const RefletPrepareInfo& info, const FrameKind& kind,
                 bool changed, std::vector<gpu::PipelineInfo>& missing) {
    view.hostImages.clear();
    view.last.reset();  // its images belong to the frame that is prepared now
    view.recorder.setSizes(sizesOf(view, view.renderSize));
    view.recorder.prepare(missing);
    const bool composed = std::exchange(view.composedLast, false);
    const uint32_t steady = std::exchange(view.steadyFrames, changed ? 0 : UINT32_MAX);
    const auto environments = std::exchange(view.store->environments, {});  // no frame has shown the stand-in
    try {
        prepareFrame(view, settingsOfFrame(view, settings, {}), info, kind);
    } catch (...) {
        view.composedLast = composed;
        view.steadyFrames = steady;
        view.store->environments = environments;
        view.recorder.drop();
        view.recorder.end();
        throw;
    }
    view.composedLast = composed;
    view.steadyFrames = steady;
    view.store->environments = environments;
    view.recorder.end();
}

// The pipelines of all frames that these effects can make, by a small view: images of the real one are not made for
// frames that may never be.
void prepareKinds(const RefletView_T& view, const Settings& settings, const RefletPrepareInfo& info,
                  std::vector<gpu::PipelineInfo>& missing) {
    constexpr uvec2 size(64);
    RefletView_T small(view.owner, 1, false);
    small.memory = view.memory;
    small.size = small.renderSize = size;
    small.outputSize = outputSizeOf(view) != view.size ? 2U * size : uvec2(0);
    small.store = std::make_unique<ViewStore>();
    for (const FrameKind& kind : frameKinds(info)) {
        small.store->environmentRests = UINT32_MAX / 2;
        prepareOnce(small, settings, info, kind, false, missing);
        small.store->environmentRests = 0;  // the environment has changed
        prepareOnce(small, settings, info, kind, info.changesSize != 0, missing);
    }
    small.recorder.finish();
}

}  // namespace

}  // namespace reflet::api

using namespace reflet;
using namespace reflet::api;

RefletResult refletPrepare(RefletView view, RefletSettings settings, const RefletPrepareInfo* info,
                           uint32_t maxPipelines, uint32_t* remaining) {
    return onView(view, [&] {
        RefletPrepareInfo given = adopted(info, "RefletPrepareInfo", offsetof(RefletPrepareInfo, changesSize));
        const std::shared_ptr<RefletSettings_T> object = held(settings, "settings");
        checkDevice(view->owner);
        if (remaining == nullptr) {
            failArgument("remaining: is NULL");
        }
        const RefletGBuffer gbuffer = adopted(given.gbuffer, "RefletPrepareInfo.gbuffer");
        given.gbuffer = &gbuffer;  // of the size that this library knows
        const RefletIndirectLight light = preparedLight(given);
        given.light = given.light != nullptr ? &light : nullptr;
        RefletToneMapInfo toneMap{};
        if (given.toneMap != nullptr) {
            toneMap = adopted(given.toneMap, "RefletPrepareInfo.toneMap");
            given.toneMap = &toneMap;
            given.autoExposure = toneMap.autoExposure;
        }
        checkBoolean(given.hasEnvironmentImage, "RefletPrepareInfo.hasEnvironmentImage");
        checkBoolean(given.autoExposure, "RefletPrepareInfo.autoExposure");
        checkBoolean(given.changesSize, "RefletPrepareInfo.changesSize");
        checkDepthKind(given.shadowDepthKind, "RefletPrepareInfo.shadowDepthKind");
        if (given.effects == 0 || (given.effects & ~allEffects) != 0) {
            failArgument("RefletPrepareInfo.effects: is {:#x}; must be a combination of RefletEffect", given.effects);
        }
        if (view->frame) {
            failArgument("view: a frame has begun; prepare before refletBeginFrame or after refletEndFrame");
        }
        std::vector<gpu::PipelineInfo> missing;
        const FrameKind whole = wholeFrame(given.effects);
        const bool changesSize = given.changesSize != 0;
        prepareOnce(*view, settings->values, given, whole, changesSize, missing);
        if (view->recorder.counts().plans > 0) {  // now all histories exist: the rest goes around them
            view->recorder.tidy();
            prepareOnce(*view, settings->values, given, whole, changesSize, missing);
        }
        prepareKinds(*view, settings->values, given, missing);
        const size_t made = std::min<size_t>(missing.size(), maxPipelines);
        for (size_t i = 0; i < made; ++i) {
            view->owner.gpu->pipelines().get(missing[i]);
        }
        *remaining = static_cast<uint32_t>(missing.size() - made);
    });
}
