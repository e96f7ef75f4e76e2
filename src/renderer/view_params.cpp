// Converts a camera to ViewParams.
#include "renderer/view_params.h"

#include <cmath>

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
    v.paddedClipToWorld = v.clipToWorld;
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

ViewParams resized(ViewParams view, uvec2 size) {
    view.pixelAngle *= view.size.y / static_cast<float>(size.y);
    view.size = vec2(size);
    view.pixel = 1.0F / view.size;
    return view;
}

}  // namespace reflet
