// Renders a scene.
#include "render/renderer.h"

#include "base/error.h"
#include "base/text.h"
#include "noise/blue_noise.h"
#include "render/jitter.h"
#include "render/probe/place_probes.h"

#include <algorithm>
#include <iterator>

namespace reflet {

Renderer::Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : frame_(device),
      source_(scene),
      scene_(device, scene, warn),
      flatPieces_(findFlatPieces(scene)),
      ggxTable_(makeGgxTable(frame_)),
      blueNoise_(
          gpu::uploadBuffer(device, std::as_bytes(blueNoise()), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "blue_noise")),
      probes_(device),
      warn_(warn) {}

LampShadows Renderer::planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings) {
    for (uint32_t i = 0; i < lamps.count; ++i) {
        lamps.lamps[i].radius = view.lampRadius.value_or(lamps.lamps[i].radius);
    }
    // Images larger than that are more memory (1 GiB) than shadows of lamps are worth.
    const uint32_t largestSide = std::min(frame_.device().limits().maxImageDimension2D, 16384U);
    return planLampShadows(lamps, settings, largestSide, [&](const std::string& text) { warnOnce(text); });
}

std::vector<Mirror> Renderer::planMirrors(const View& view, const ViewParams& params, const Settings& settings) {
    if (settings.planar.enabled == 0 || settings.specular.rays == 0 || settings.materials.lambertOnly != 0) {
        return {};
    }
    for (const std::string& name : view.mirrors) {
        if (std::ranges::find(flatPieces_, name, &FlatPiece::name) == flatPieces_.end()) {
            std::vector<std::string> names;
            std::ranges::transform(flatPieces_, std::back_inserter(names), &FlatPiece::name);
            warnOnce(fmt::format("mirrors: no flat thing is called '{}'{}", name, suggestion(name, names)));
        }
    }
    return reflet::planMirrors(flatPieces_, params, view.mirrors, settings.planar);
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
    if (!traced_ || tracedTextureSize_ != settings.traceScene.textureSize) {
        tracedTextureSize_ = settings.traceScene.textureSize;
        gpu::Device& device = frame_.device();
        traced_.emplace(
            TracedScene{SceneRays(device, source_), SceneSurfaces(device, source_, scene_, tracedTextureSize_, warn_)});
    }
    return &*traced_;
}

const std::vector<Probe>& Renderer::probesOf(const View& view, const ProbesSettings& settings) {
    if (view.probes) {
        return *view.probes;
    }
    if (settings.enabled != 0 && placedCount_ != settings.count) {
        placed_ = placeProbes(source_, settings.count);
        placedCount_ = settings.count;
    }
    return placed_;
}

namespace {

bool sameView(const View& a, const View& b) {
    return worldToView(a.camera) == worldToView(b.camera) && viewToClip(a.camera, 1.0F) == viewToClip(b.camera, 1.0F) &&
           a.sun.direction == b.sun.direction && a.sun.irradiance == b.sun.irradiance &&
           a.sun.angularDiameter == b.sun.angularDiameter && a.lampRadius == b.lampRadius && a.mirrors == b.mirrors &&
           a.probes == b.probes && a.environment.radiance == b.environment.radiance &&
           a.environment.image == b.environment.image && a.environment.intensity == b.environment.intensity &&
           a.environment.rotation == b.environment.rotation;
}

// Pixels off the centre.
vec2 jitterOf(const Settings& settings, uint32_t frame, uint32_t framesBefore) {
    if (settings.accumulate.enabled != 0) {
        return settings.accumulate.jitter != 0 ? placeInPixel(framesBefore) : vec2(0.0F);
    }
    return settings.temporal.enabled != 0 ? placeInPixel(frame) : vec2(0.0F);
}

}  // namespace

uint32_t Renderer::countFramesBefore(const View& view, const ViewParams& params, const Settings& settings) {
    const bool same = asked_ && sameView(asked_->view, view) && asked_->size == params.size &&
                      asked_->seed == params.seed && sameSettings(asked_->settings, settings);
    framesBefore_ = same ? framesBefore_ + 1 : 0;
    asked_ = Asked{view, settings, params.size, params.seed};
    return framesBefore_;
}

// New pictures are cleared first, in a frame of their own: what captures probes may show them before this frame is
// submitted.
std::vector<LiveView> Renderer::liveViews(const ViewParams& view) {
    std::vector<LiveView> live;
    for (GpuScene::LivePicture& p : scene_.livePictures()) {
        const gpu::Image picture = p.texture.image();
        if (p.fresh) {
            gpu::Frame f(frame_.device());
            f.begin();
            f.clear(picture);
            f.submit();
            f.wait();
            p.fresh = false;
        }
        live.push_back({makeViewParams(p.camera, picture.size, view.frame, view.seed), picture});
    }
    return live;
}

FrameImages Renderer::render(const View& view, uvec2 size, uint32_t seed, const Settings& settings,
                             const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    ViewParams params = makeViewParams(view.camera, size, frameNumber_++, seed);
    params.previousWorldToClip = previousWorldToClip_.value_or(params.worldToClip);
    previousWorldToClip_ = params.worldToClip;
    const uint32_t framesBefore = countFramesBefore(view, params, settings);
    const std::vector<Mirror> mirrors = planMirrors(view, params, settings);  // their pictures' sizes do not jitter
    const vec2 place = jitterOf(settings, params.frame, framesBefore);
    lookThrough(params, place, previousPlace_);
    previousPlace_ = place;
    LampBlock lamps = scene_.lamps();
    const LampShadows lampShadows = planLamps(lamps, view, settings.shadow);
    scene_.setTextureFilter(settings.materials.anisotropy, settings.materials.mips != 0);
    scene_.setLiveHeight(settings.live.height);
    const std::vector<LiveView> live = liveViews(params);
    const TracedScene* traced = tracedScene(settings);
    frame_.begin();
    FrameInputs inputs{{.draws = scene_.draws(),
                        .view = params,
                        .sunDirection = view.sun.direction,
                        .sunIrradiance = view.sun.irradiance,
                        .sunAngularDiameter = view.sun.angularDiameter,
                        .environment = environment_.update(frame_.device(), view.environment),
                        .lamps = lamps,
                        .lampShadows = lampShadows,
                        .ggxTable = ggxTable_.image(),
                        .blueNoise = blueNoise_.view(),
                        .traced = traced},
                       mirrors,
                       live,
                       framesBefore};
    inputs.probes = probes_.update(frame_, inputs, probesOf(view, settings.probes), settings);
    const FrameImages images = renderFrame(frame_, inputs, settings);
    if (after) {
        after(frame_, images);
    }
    frame_.submit();
    frame_.wait();
    return images;
}

}  // namespace reflet
