// Derives view parameters from matrices.
#include "lighting/camera.h"

#include <cmath>

namespace reflet::lighting {

namespace {

// z of view space per metre in front of the camera: 1 or -1.
float forwardOf(const mat4& p) {
    const float perspective = p[2][3];
    return perspective != 0.0F ? (perspective > 0.0F ? 1.0F : -1.0F) : (p[2][2] > 0.0F ? -1.0F : 1.0F);
}

// ViewParams::depthToDistance. Depth is (a z + b) / (c z + e) of view space's z.
vec4 depthToDistance(const mat4& p, float forward) {
    const float a = p[2][2];
    const float b = p[3][2];
    const float c = p[2][3];
    const float e = p[3][3];
    const vec4 fraction(forward * b, -forward * e, -a, c);
    return fraction.z + 0.5F * fraction.w < 0.0F ? -fraction : fraction;
}

}  // namespace

ViewParams viewOf(const mat4& worldToView, const mat4& viewToClip, uvec2 size) {
    // Inverted in double: an infinite far plane makes the matrix badly conditioned.
    const glm::dmat4 viewToWorld = glm::inverse(glm::dmat4(worldToView));
    const float forward = forwardOf(viewToClip);
    const bool orthographic = viewToClip[2][3] == 0.0F;
    ViewParams v{};
    v.worldToClip = viewToClip * worldToView;
    v.clipToWorld = mat4(viewToWorld * glm::inverse(glm::dmat4(viewToClip)));
    v.previousWorldToClip = v.worldToClip;
    v.paddedClipToWorld = v.clipToWorld;
    v.viewPlane = forward * glm::transpose(worldToView)[2];
    v.eye = orthographic ? vec4(-vec3(v.viewPlane), 0.0F) : vec4(vec3(viewToWorld[3]), 1.0F);
    v.depthToDistance = depthToDistance(viewToClip, forward);
    v.size = vec2(size);
    v.pixel = 1.0F / v.size;
    v.pixelAngle = 2.0F / (std::abs(viewToClip[1][1]) * v.size.y);
    v.preExposure = 1.0F;
    v.exposureChange = 1.0F;
    return v;
}

}  // namespace reflet::lighting
