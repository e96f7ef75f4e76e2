// Converts a camera to ViewParams.
#include "renderer/view_params.h"

#include "lighting/camera.h"

#include <cmath>

namespace reflet {

ViewParams makeViewParams(const Camera& camera, uvec2 size, uint32_t frame, uint32_t seed) {
    const vec2 pixels(size);
    const mat4 toView = worldToView(camera);
    const mat4 toClip = viewToClip(camera, pixels.x / pixels.y);
    const bool orthographic = camera.orthographicHeight > 0.0F;
    ViewParams v = lighting::viewOf(toView, toClip, size);
    // Known exactly; the matrices are rounded.
    if (!orthographic) {
        v.eye = vec4(camera.position, 1.0F);
    }
    v.depthToDistance =
        orthographic ? vec4(camera.far, camera.near - camera.far, 1.0F, 0.0F) : vec4(camera.near, 0.0F, 0.0F, 1.0F);
    const float height = orthographic ? camera.orthographicHeight : 2.0F * std::tan(0.5F * camera.fovY);
    v.pixelAngle = height / pixels.y;
    v.frame = frame;
    v.seed = seed;
    v.exposureChange = 1.0F;
    return v;
}

ViewParams makeViewParams(const Camera& camera, uvec2 size, const ViewParams& frameView) {
    ViewParams v = makeViewParams(camera, size, frameView.frame, frameView.seed);
    v.preExposure = frameView.preExposure;
    return v;
}

ViewParams resized(ViewParams view, uvec2 size) {
    view.pixelAngle *= view.size.y / static_cast<float>(size.y);
    view.jitter *= vec2(size) / view.size;
    view.size = vec2(size);
    view.pixel = 1.0F / view.size;
    return view;
}

}  // namespace reflet
