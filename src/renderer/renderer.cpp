// Renders a scene.
#include "renderer/renderer.h"

#include "base/error.h"
#include "base/text.h"
#include "device/upload.h"
#include "lighting/jitter.h"
#include "noise/blue_noise.h"
#include "renderer/draw_shadows/lamp_shadow_maps.h"
#include "renderer/history.h"
#include "renderer/probe/place_probes.h"
#include "renderer/reflected_suns.h"
#include "renderer/scene_exposure/scene_exposure.h"
#include "scene/background.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace reflet {

namespace {

// What moves changes the light around it, which the lights do not tell.
constexpr float movedChange = 0.2F;

void addLamps(LampBlock& block, const std::vector<Lamp>& lamps) {
    for (const Lamp& lamp : lamps) {
        if (block.count < maxLamps) {
            block.lamps[block.count++] = lampParams(lamp);
        }
    }
}

}  // namespace

Renderer::Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : frame_(device),
      source_(scene),
      scene_(device, scene, warn),
      flatPieces_(findFlatPieces(scene)),
      posedPieces_(flatPieces_),
      blueNoise_(
          gpu::uploadBuffer(device, std::as_bytes(blueNoise()), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "blue_noise")),
      warn_(warn),
      preExposure_(scene) {}

void Renderer::pose(const View& view) {
    if (source_.nodes.empty()) {
        return;
    }
    ScenePose now = scenePose(source_, view.time);
    if (!pose_ || pose_->time != now.time) {
        posedPieces_ = posedFlatPieces(flatPieces_, source_, now);
    }
    scene_.pose(source_, now, pose_.value_or(now));
    pose_ = std::move(now);
}

LampBlock Renderer::ownLamps(const View& view, const Settings& settings) const {
    LampBlock lamps = scene_.lamps(lightsByEmitters(settings));
    for (uint32_t i = 0; i < lamps.count; ++i) {
        if (lamps.lamps[i].type == lampEmitter) {
            continue;
        }
        if (lamps.lamps[i].type != lampDirectional) {
            lamps.lamps[i].radius = view.lampRadius.value_or(lamps.lamps[i].radius);
        }
        if (std::ranges::binary_search(view.lampsOff, i)) {
            lamps.lamps[i].intensity = vec3(0.0F);
        }
    }
    return lamps;
}

LampShadows Renderer::planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings) {
    // Images larger than that are more memory (1 GiB) than shadows of lamps are worth.
    const uint32_t largestSide = std::min(frame_.device().limits().maxImageDimension2D, 16384U);
    const Camera& camera = view.camera;
    const LampShadowScene scene{scene_.draws().boundsW, camera.position,
                                glm::normalize(camera.target - camera.position)};
    const LampShadows shadows =
        planLampShadows(lamps, settings, largestSide, scene, [&](const std::string& text) { warnOnce(text); });
    for (uint32_t i = 0; i < lamps.count; ++i) {
        if (lamps.lamps[i].type == lampReflected && lamps.lamps[i].shadow == noLampShadow &&
            settings.filter != ShadowFilter::traced) {
            lamps.lamps[i].intensity = vec3(0.0F);
        }
    }
    return shadows;
}

void Renderer::addReflectedSuns(LampBlock& lamps, const View& view, const Settings& settings) const {
    for (const LampParams& sun : reflectedSuns(posedPieces_, -view.sun.direction, view.sun.irradiance,
                                               view.sun.angularDiameter, mostReflectedSuns(settings))) {
        if (lamps.count < maxLamps) {
            lamps.lamps[lamps.count++] = sun;
        }
    }
}

std::vector<Mirror> Renderer::planMirrors(const View& view, const ViewParams& params, const Settings& settings) {
    if (settings.planar.enabled == 0 || settings.specular.rays == 0 || settings.materials.lambertOnly != 0) {
        return {};
    }
    for (const std::string& name : view.mirrors) {
        if (std::ranges::find(posedPieces_, name, &FlatPiece::name) == posedPieces_.end()) {
            std::vector<std::string> names;
            std::ranges::transform(posedPieces_, std::back_inserter(names), &FlatPiece::name);
            warnOnce(fmt::format("mirrors: no flat thing is called '{}'{}", name, suggestion(name, names)));
        }
    }
    return reflet::planMirrors(posedPieces_, params, view.mirrors, settings.planar);
}

void Renderer::warnOnce(const std::string& text) {
    if (warned_.insert(text).second) {
        warn_(text);
    }
}

const TracedScene* Renderer::tracedScene(const Settings& settings) {
    if (!tracesScene(settings)) {
        return nullptr;
    }
    gpu::Device& device = frame_.device();
    const TraceSceneSettings& s = settings.traceScene;
    const RayMethod method = s.rayQuery != 0 && device.hasRayQuery() ? RayMethod::query : RayMethod::traversal;
    if (!traced_ || tracedTextureSize_ != s.textureSize || traced_->rays.method() != method) {
        tracedTextureSize_ = s.textureSize;
        traced_.emplace(TracedScene{SceneRays(device, source_, method),
                                    SceneSurfaces(device, source_, scene_, tracedTextureSize_, warn_)});
        tracedTime_.reset();
    }
    if (pose_ && tracedTime_ != pose_->time) {
        tracedTime_ = pose_->time;
        traced_->rays.pose(device, source_, *pose_);
        traced_->surfaces.pose(device, source_, scene_, *pose_);
    }
    return &*traced_;
}

const std::vector<Probe>& Renderer::probesOf(const View& view, const ProbesSettings& settings) {
    if (view.probes) {
        return *view.probes;
    }
    if (settings.enabled != 0 && placedCount_ != settings.count) {
        placed_ = source_.nodes.empty() ? placeProbes(source_, settings.count, view.camera.position)
                                        : placeProbes(frozen(source_, 0.0), settings.count, view.camera.position);
        placedCount_ = settings.count;
    }
    return placed_;
}

void Renderer::countFramesBefore(const View& view, const ViewParams& params, const Settings& settings) {
    Asked now{view, settings, params.size, params.seed};
    now.settings.composite.layers = 0;  // changes no light
    if (source_.nodes.empty()) {
        now.view.time = 0.0;  // nor does time
    }
    const bool same = asked_ && asked_->view == now.view && asked_->size == now.size && asked_->seed == now.seed &&
                      sameSettings(asked_->settings, now.settings);
    framesBefore_ = same ? framesBefore_ + 1 : 0;
    asked_ = std::move(now);
}

// New pictures are cleared: what captures probes, or shows itself in its own picture, reads them before they are drawn.
std::vector<LiveView> Renderer::liveViews(const ViewParams& view) {
    std::vector<LiveView> live;
    for (GpuScene::LivePicture& p : scene_.livePictures()) {
        const gpu::Image picture = p.texture.image();
        if (p.fresh) {
            frame_.clear(picture);
            p.fresh = false;
        }
        live.push_back({makeViewParams(p.posed, picture.size, view), picture});
    }
    return live;
}

View Renderer::withSuns(const View& view, const Settings& settings, std::vector<Lamp>& others) {
    if (settings.environment.enabled == 0) {
        return view;
    }
    if (sunsFrom_ != view.environment.image) {
        sunsFrom_ = view.environment.image;
        suns_ = sunsFrom_ ? findImageSuns(*sunsFrom_) : ImageSuns{};
    }
    return withImageSuns(view, suns_, others);
}

FrameBackground Renderer::backgroundOf(const View& view, const View& lit) {
    const Background& background = view.background;
    const bool constant = background.mode == Background::Mode::blur && !view.environment.image;
    const bool same = view.environment.image == lit.environment.image;
    if ((background.mode == Background::Mode::environment && same) || constant) {
        return {};
    }
    if (needsBlurredImage(view) && blurredFrom_ != view.environment.image) {
        blurredFrom_ = view.environment.image;
        blurred_ = std::make_shared<FloatImage>(blurredImage(*blurredFrom_));
    }
    return {background, background_.update(frame_, environmentBehind(view, blurred_))};
}

// A change of the pre-exposure is rare: an animation that dims the light by many stops has one now and then. So
// histories start again rather than being rescaled.
float Renderer::preExpose(LampBlock& lamps, View& view) {
    const float before = preExposure_.value();
    const float factor = preExposure_.update(lamps, view);
    if (factor != before) {
        forgetLight();
        probes_.restart(true);
    }
    view.sun.irradiance *= factor;
    view.environment.radiance *= factor;
    view.environment.intensity *= factor;
    for (uint32_t i = 0; i < lamps.count; ++i) {
        lamps.lamps[i].intensity *= factor;
    }
    return factor;
}

void Renderer::forgetLight() {
    frame_.forget();
    framesBefore_ = 0;
    for (GpuScene::LivePicture& picture : scene_.livePictures()) {
        picture.fresh = true;
    }
}

void Renderer::restart(uint32_t frameNumber) {
    frameNumber_ = frameNumber;
    forgetLight();
    previousWorldToClip_.reset();
    previousPlace_ = vec2(0.0F);
    previousTime_.reset();
    asked_.reset();
    lightChange_.forget();
    preExposure_.forget();
    cache_.forget();
    pose_.reset();
    probes_.restart(!source_.nodes.empty());
}

// Without jitter, which mirrors' sizes must not follow, and without pre-exposure.
ViewParams Renderer::nextParams(const View& view, uvec2 size, uint32_t seed, const Settings& settings) {
    ViewParams params = resized(makeViewParams(view.camera, size, frameNumber_++, seed), renderSize(settings, size));
    params.previousWorldToClip = previousWorldToClip_.value_or(params.worldToClip);
    previousWorldToClip_ = params.worldToClip;
    countFramesBefore(view, params, settings);
    params.rest = framesBefore_;
    return params;
}

std::optional<mat4> Renderer::cameraBefore(const ViewParams& view, uvec2 size, const Settings& settings,
                                           bool startsAgain) const {
    if (!blurSince_) {
        return startsAgain ? std::optional(view.previousWorldToClip) : std::nullopt;
    }
    ViewParams before = resized(makeViewParams(*blurSince_, size, 0, 0), renderSize(settings, size));
    applyJitter(before, previousPlace_, previousPlace_);  // that of this frame
    return before.worldToClip;
}

FrameImages Renderer::render(const View& asked, uvec2 size, uint32_t seed, const Settings& settings,
                             const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    View shown = posed(asked, source_);
    std::vector<Lamp> otherSuns;
    View view = withSuns(shown, settings, otherSuns);
    const double posedBefore = pose_ ? pose_->time : -1.0;
    pose(view);
    const bool moved = posedBefore >= 0.0 && pose_->time != posedBefore;
    LampBlock lamps = ownLamps(view, settings);
    addReflectedSuns(lamps, view, settings);
    addLamps(lamps, otherSuns);
    const LampShadows lampShadows = planLamps(lamps, view, settings.shadow);
    const float lightChange = lightChange_.update(lamps, view);
    ViewParams params = nextParams(view, size, seed, settings);
    params.preExposure = preExpose(lamps, view);
    shown.environment.radiance *= params.preExposure;
    shown.environment.intensity *= params.preExposure;
    const std::vector<Mirror> mirrors = planMirrors(view, params, settings);  // their pictures' sizes do not jitter
    const vec2 place = frameJitter(settings, params.frame, params.rest);
    applyJitter(params, place, previousPlace_);
    previousPlace_ = place;
    scene_.setTextureFilter({settings.materials.anisotropy, settings.materials.mips != 0,
                             settings.materials.mipBias + std::log2(params.size.y / static_cast<float>(size.y))});
    scene_.setLiveHeight(settings.live.height);
    const TracedScene* traced = tracedScene(settings);
    frame_.begin();
    if (pose_ && scene_.hasSkins()) {
        scene_.skin(frame_);
    }
    const std::vector<LiveView> live = liveViews(params);
    FrameInputs inputs{
        {.draws = scene_.draws(),
         .view = params,
         .sunDirection = view.sun.direction,
         .sunIrradiance = view.sun.irradiance,
         .sunAngularDiameter = view.sun.angularDiameter,
         .environment = environment_.update(frame_, view.environment),
         .lamps = lamps,
         .lampShadows = lampShadows,
         .ggxTable = lighting::ggxTable(frame_, ggxTable_),
         .blueNoise = blueNoise_.view(),
         .traced = traced,
         .time = view.time,
         .medium = cameraMedium(volumes_, source_, pose_ ? &*pose_ : nullptr, scene_.draws(), view.camera)},
        mirrors,
        live,
        lightChange,
        backgroundOf(shown, view),  // NOLINT(readability-suspicious-call-argument)
        exposesAutomatically(settings.tonemap, source_),
        static_cast<float>(std::abs(asked.time - previousTime_.value_or(asked.time))),
        size,
        place,
        Lens{view.camera.apertureRadius, view.camera.focusDistance, view.camera.blades, view.camera.bladeRotation},
        cameraBefore(params, size, settings, moved && pose_->time < posedBefore && asked.time > previousTime_)};
    previousTime_ = asked.time;
    inputs.probes = probes_.update(frame_, inputs, probesOf(view, settings.probes), settings);
    if (settings.radianceCache.enabled != 0) {
        inputs.cache = cache_.update(frame_, settings.radianceCache, std::max(lightChange, moved ? movedChange : 0.0F),
                                     params.preExposure);
    }
    if (stop_) {
        frame_.runPassByPass(stop_);
    }
    FrameImages images = renderFrame(frame_, store_, inputs, settings);
    frame_.keep(images.display);
    if (after) {
        after(frame_, images);
    }
    frame_.submit();
    frame_.wait();
    return images;
}

}  // namespace reflet
