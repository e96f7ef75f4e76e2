// Renders a scene.
#include "render/renderer.h"

#include "base/error.h"
#include "base/text.h"
#include "noise/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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
      scene_(device, scene, warn),
      flatPieces_(findFlatPieces(scene)),
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

FrameImages Renderer::render(const View& view, uvec2 size, uint32_t seed, const Settings& settings,
                             const std::function<void(gpu::Frame&, const FrameImages&)>& after) {
    checkCanRender(view);
    ViewParams params = makeViewParams(view.camera, size, frameNumber_++, seed);
    params.previousWorldToClip = previousWorldToClip_.value_or(params.worldToClip);
    previousWorldToClip_ = params.worldToClip;
    LampBlock lamps = scene_.lamps();
    const LampShadows lampShadows = planLamps(lamps, view, settings.shadow);
    const std::vector<Mirror> mirrors = planMirrors(view, params, settings);
    scene_.setAnisotropy(settings.materials.anisotropy);
    scene_.setLiveHeight(settings.live.height);
    std::vector<LiveView> live;
    for (GpuScene::LivePicture& p : scene_.livePictures()) {
        const gpu::Image picture = p.texture.image();
        live.push_back({makeViewParams(p.camera, picture.size, params.frame, seed), picture, p.fresh});
        p.fresh = false;
    }
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
                              .blueNoise = blueNoise_.view()},
                             mirrors,
                             live};
    const FrameImages images = renderFrame(frame_, inputs, settings);
    if (after) {
        after(frame_, images);
    }
    frame_.submit();
    frame_.wait();
    return images;
}

}  // namespace reflet
