// Renders a scene.
#include "render/renderer.h"

#include "base/error.h"
#include "noise/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace reflet {

ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed) {
    const vec2 pixels(size);
    const mat4 toView = worldToView(camera);
    const mat4 toClip = viewToClip(camera, pixels.x / pixels.y);
    const bool orthographic = camera.orthographicHeight > 0.0F;
    const vec3 toCamera(glm::transpose(toView)[2]);
    ViewParams v{};
    v.worldToClip = toClip * toView;
    // Inverted in double: an infinite far plane makes the matrix badly conditioned.
    v.clipToWorld = mat4(glm::inverse(glm::dmat4(toView)) * glm::inverse(glm::dmat4(toClip)));
    v.previousWorldToClip = v.worldToClip;
    v.eye = orthographic ? vec4(toCamera, 0.0F) : vec4(camera.position, 1.0F);
    v.viewPlane = -glm::transpose(toView)[2];
    v.depthToDistance =
        orthographic ? vec4(camera.far, camera.near - camera.far, 1.0F, 0.0F) : vec4(camera.near, 0.0F, 0.0F, 1.0F);
    v.size = pixels;
    v.pixel = 1.0F / pixels;
    const float height = orthographic ? camera.orthographicHeight : 2.0F * std::tan(0.5F * camera.fovY);
    v.pixelAngle = height / pixels.y;
    v.frame = frame;
    v.seed = seed;
    return v;
}

void checkCanRender(const View& view) {
    if (view.environment.image) {
        fail(
            "environment images are only used by 'reflet reference' in this version; give environment.radiance in the "
            "view file instead");
    }
}

Renderer::Renderer(gpu::Device& device, const Scene& scene, const std::function<void(const std::string&)>& warn)
    : frame_(device),
      source_(scene),
      scene_(device, scene, warn),
      ggxTable_(makeGgxTable(frame_)),
      blueNoise_(
          gpu::uploadBuffer(device, std::as_bytes(blueNoise()), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "blue_noise")),
      warn_(warn) {}

LampShadows Renderer::planLamps(LampBlock& lamps, const View& view, const ShadowSettings& settings) {
    for (uint32_t i = 0; i < lamps.count; ++i) {
        lamps.lamps[i].radius = view.lampRadius.value_or(lamps.lamps[i].radius);
    }
    // Images larger than that are more memory (1 GiB) than shadows of lamps are worth.
    const uint32_t largestSide = std::min(frame_.device().limits().maxImageDimension2D, 16384U);
    return planLampShadows(lamps, settings, largestSide, [&](const std::string& text) {
        if (warned_.insert(text).second) {
            warn_(text);
        }
    });
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

namespace {

bool sameView(const View& a, const View& b) {
    return worldToView(a.camera) == worldToView(b.camera) && viewToClip(a.camera, 1.0F) == viewToClip(b.camera, 1.0F) &&
           a.sun.direction == b.sun.direction && a.sun.irradiance == b.sun.irradiance &&
           a.sun.angularDiameter == b.sun.angularDiameter && a.lampRadius == b.lampRadius &&
           a.environment.radiance == b.environment.radiance && a.environment.image == b.environment.image &&
           a.environment.intensity == b.environment.intensity && a.environment.rotation == b.environment.rotation;
}

// The R2 sequence: spread evenly over the pixel, however many there are. -0.5 to 0.5, the first in the middle.
// (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018)
vec2 placeInPixel(uint32_t index) {
    constexpr double step[] = {0.7548776662466927, 0.5698402909980532};
    const auto at = [&](double s) { return static_cast<float>(std::fmod(0.5 + index * s, 1.0) - 0.5); };
    return {at(step[0]), at(step[1])};
}

// Moves the picture such that pixels' centres show what was `place` pixels off them.
void lookThrough(ViewParams& view, const vec2& place) {
    const vec2 shift = -2.0F * place * view.pixel;  // in clip space, where w is 1
    mat4 move(1.0F);
    move[3] = vec4(shift, 0.0F, 1.0F);
    mat4 back(1.0F);
    back[3] = vec4(-shift, 0.0F, 1.0F);
    view.worldToClip = move * view.worldToClip;
    view.clipToWorld = view.clipToWorld * back;
}

}  // namespace

uint32_t Renderer::countFramesBefore(const View& view, const ViewParams& params, const Settings& settings) {
    // All members are four bytes: there is no padding.
    static_assert(std::is_trivially_copyable_v<Settings>);
    const bool same = asked_ && sameView(asked_->view, view) && asked_->size == params.size &&
                      asked_->seed == params.seed && std::memcmp(&asked_->settings, &settings, sizeof(settings)) == 0;
    framesBefore_ = same ? framesBefore_ + 1 : 0;
    asked_ = Asked{view, settings, params.size, params.seed};
    return framesBefore_;
}

FrameImages Renderer::render(const View& view, uvec2 size, uint32_t seed, const Settings& settings,
                             const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    checkCanRender(view);
    ViewParams params = makeViewParams(view.camera, size, frameNumber_++, seed);
    params.previousWorldToClip = previousWorldToClip_.value_or(params.worldToClip);
    previousWorldToClip_ = params.worldToClip;
    const uint32_t framesBefore = countFramesBefore(view, params, settings);
    if (settings.accumulate.enabled != 0 && settings.accumulate.jitter != 0) {
        lookThrough(params, placeInPixel(framesBefore));
    }
    LampBlock lamps = scene_.lamps();
    const LampShadows lampShadows = planLamps(lamps, view, settings.shadow);
    scene_.setTextureFilter(settings.materials.anisotropy, settings.materials.mips != 0);
    const TracedScene* traced = tracedScene(settings);
    frame_.begin();
    const FrameInputs inputs{{.draws = scene_.draws(),
                              .view = params,
                              .sunDirection = view.sun.direction,
                              .sunIrradiance = view.sun.irradiance,
                              .sunAngularDiameter = view.sun.angularDiameter,
                              .environment = view.environment.radiance,
                              .lamps = lamps,
                              .lampShadows = lampShadows,
                              .ggxTable = ggxTable_.image(),
                              .blueNoise = blueNoise_.view(),
                              .traced = traced},
                             framesBefore};
    const FrameImages images = renderFrame(frame_, inputs, settings);
    if (after) {
        after(frame_, images);
    }
    frame_.submit();
    frame_.wait();
    return images;
}

}  // namespace reflet
