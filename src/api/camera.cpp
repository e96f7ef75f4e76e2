// A host's matrices and conventions as Reflet's.
#include "api/camera.h"

#include "api/calls.h"
#include "lighting/camera.h"
#include "lighting/jitter.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace reflet::api {

namespace {

mat4 matrixOf(const float (&values)[16], const char* name) {
    mat4 m;
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(values[i])) {
            failArgument("RefletFrameInfo.{}[{}]: is not finite", name, i);
        }
        m[i / 4][i % 4] = values[i];
    }
    return m;
}

bool isZero(const float (&values)[16]) {
    return std::ranges::all_of(values, [](float value) { return value == 0.0F; });
}

// To clip space with y down and reversed depth.
mat4 reflectedProjection(mat4 viewToClip, const RefletFrameInfo& info) {
    for (int column = 0; column < 4; ++column) {
        vec4& c = viewToClip[column];
        c.y = info.clipYUp != 0 ? -c.y : c.y;
        c.z = info.gbuffer.depthKind == REFLET_DEPTH_STANDARD ? c.w - c.z : c.z;
    }
    return viewToClip;
}

void checkCamera(const mat4& toView, const mat4& toClip, const mat4& clipToWorld) {
    const float scale = glm::determinant(glm::mat3(toView));
    if (std::abs(std::abs(scale) - 1.0F) > 0.01F) {
        failArgument("RefletFrameInfo.worldToView: scales by {}; it must be a rotation and a translation, in metres",
                     std::cbrt(std::abs(scale)));
    }
    if (toClip[0][0] == 0.0F || toClip[1][1] == 0.0F || (toClip[2][3] == 0.0F && toClip[2][2] == 0.0F)) {
        failArgument("RefletFrameInfo.viewToClip: is no projection; matrices are column-major");
    }
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(clipToWorld[i / 4][i % 4])) {
            failArgument("RefletFrameInfo.viewToClip: cannot be inverted");
        }
    }
}

}  // namespace

ViewParams viewParams(const RefletFrameInfo& info, uvec2 size) {
    const mat4 toView = matrixOf(info.worldToView, "worldToView");
    const mat4 toClip = reflectedProjection(matrixOf(info.viewToClip, "viewToClip"), info);
    ViewParams v = lighting::viewOf(toView, toClip, size);
    checkCamera(toView, toClip, v.clipToWorld);
    const bool first = isZero(info.previousWorldToView) && isZero(info.previousViewToClip);
    v.previousWorldToClip = first ? v.worldToClip
                                  : reflectedProjection(matrixOf(info.previousViewToClip, "previousViewToClip"), info) *
                                        matrixOf(info.previousWorldToView, "previousWorldToView");
    v.frame = info.frameIndex;
    v.rest = info.restFrames;
    const auto jitterOf = [](const float(&given)[2], const char* name) {
        if (!(std::abs(given[0]) <= 1.0F && std::abs(given[1]) <= 1.0F)) {
            failArgument("RefletFrameInfo.{}: is ({}, {}) pixels; must be -1 to 1", name, given[0], given[1]);
        }
        return vec2(given[0], given[1]);
    };
    applyJitter(v, jitterOf(info.jitter, "jitter"), jitterOf(info.previousJitter, "previousJitter"));
    return v;
}

ImportParams importParams(const RefletFrameInfo& info, const ViewParams& view) {
    const RefletGBuffer& g = info.gbuffer;
    ImportParams params{};
    params.view = view;
    params.normalToWorld = mat4(1.0F);
    if (g.normalsInViewSpace != 0) {
        params.normalToWorld = mat4(glm::transpose(glm::mat3(matrixOf(info.worldToView, "worldToView"))));
    }
    vec2 factor(1.0F);
    if (g.motionKind == REFLET_MOTION_NDC) {
        factor = vec2(0.5F, info.clipYUp != 0 ? -0.5F : 0.5F);
    } else if (g.motionKind == REFLET_MOTION_PIXELS) {
        factor = view.pixel;
    }
    params.motionToUv = g.motionIsBeforeMinusNow != 0 ? -factor : factor;
    params.motionOffset = g.motionIncludesJitter != 0 ? view.jitterChange : vec2(0.0F);
    return params;
}

}  // namespace reflet::api
