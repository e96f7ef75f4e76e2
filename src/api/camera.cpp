// A host's matrices and conventions as Reflet's.
#include "api/camera.h"

#include "api/calls.h"
#include "lighting/camera.h"
#include "lighting/jitter.h"

#include <algorithm>
#include <cmath>

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
mat4 reflectedProjection(mat4 viewToClip, const RefletFrameInfo& info, RefletDepthKind depthKind) {
    for (int column = 0; column < 4; ++column) {
        vec4& c = viewToClip[column];
        c.y = info.clipYUp != 0 ? -c.y : c.y;
        c.z = info.clipDepthFromMinusOne != 0 ? 0.5F * (c.z + c.w) : c.z;
        c.z = depthKind == REFLET_DEPTH_STANDARD ? c.w - c.z : c.z;
    }
    return viewToClip;
}

mat4 rigid(const float (&values)[16], const char* name) {
    const mat4 m = matrixOf(values, name);
    if (m[0][3] != 0.0F || m[1][3] != 0.0F || m[2][3] != 0.0F || m[3][3] != 1.0F) {
        failArgument(
            "RefletFrameInfo.{}: its last row is ({}, {}, {}, {}); must be (0, 0, 0, 1). Matrices are column-major",
            name, m[0][3], m[1][3], m[2][3], m[3][3]);
    }
    const glm::mat3 turn(m);
    const float scale = glm::determinant(turn);
    const glm::mat3 product = glm::transpose(turn) * turn;
    float off = std::abs(std::abs(scale) - 1.0F);
    for (int i = 0; i < 9; ++i) {
        off = std::max(off, std::abs(product[i / 3][i % 3] - (i % 4 == 0 ? 1.0F : 0.0F)));
    }
    if (!(off <= 0.01F)) {
        failArgument(
            "RefletFrameInfo.{}: scales by {}, or is skewed; it must be a rotation and a translation, in metres", name,
            std::cbrt(std::abs(scale)));
    }
    if (!(glm::length(vec3(m[3])) < 1e12F)) {
        failArgument("RefletFrameInfo.{}: moves by {} metres; must be below 1e12", name, glm::length(vec3(m[3])));
    }
    return m;
}

// Of a perspective projection with reversed depth: depth falls with distance as slope + nearness / distance.
void checkDepth(const mat4& toClip, RefletDepthKind kind) {
    const float forward = toClip[2][3];
    const float slope = toClip[2][2] / forward;
    const float nearness = toClip[3][2];
    const bool reversed = kind == REFLET_DEPTH_REVERSED;
    if (!(nearness > 0.0F)) {
        failArgument(
            "RefletGBuffer.depthKind: is {}, and with RefletFrameInfo.viewToClip depth {} with distance; one of "
            "them is wrong",
            reversed ? "REFLET_DEPTH_REVERSED" : "REFLET_DEPTH_STANDARD", reversed ? "rises" : "falls");
    }
    const float near = nearness / (1.0F - slope);
    if (!(near > 1e-6F && near < 1e9F)) {
        failArgument(
            "RefletFrameInfo.viewToClip: its near plane is at {} metres; must be 1e-6 to 1e9. OpenGL's projections "
            "need clipDepthFromMinusOne",
            near);
    }
}

void checkProjection(const mat4& toClip, const mat4& clipToWorld, RefletDepthKind kind) {
    const bool perspective = toClip[2][3] != 0.0F;
    if (toClip[0][0] == 0.0F || toClip[1][1] == 0.0F || (!perspective && toClip[2][2] == 0.0F) ||
        toClip[0][3] != 0.0F || toClip[1][3] != 0.0F) {
        failArgument("RefletFrameInfo.viewToClip: is no projection; matrices are column-major");
    }
    for (const int axis : {0, 1}) {
        if (const float zoom = std::abs(toClip[axis][axis]); !(zoom > 1e-7F && zoom < 1e7F)) {
            failArgument("RefletFrameInfo.viewToClip[{}]: is {}; must be 1e-7 to 1e7", 5 * axis, toClip[axis][axis]);
        }
    }
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(clipToWorld[i / 4][i % 4])) {
            failArgument("RefletFrameInfo.viewToClip: cannot be inverted");
        }
    }
    if (perspective) {
        checkDepth(toClip, kind);
    }
}

vec2 jitterOf(const float (&given)[2], const char* name) {
    constexpr float most = 0.5001F;  // of a sequence that rounds
    if (!(std::abs(given[0]) <= most && std::abs(given[1]) <= most)) {
        failArgument("RefletFrameInfo.{}: is ({}, {}) pixels; must be -0.5 to 0.5", name, given[0], given[1]);
    }
    return {given[0], given[1]};
}

// A projection off its centre by just what the jitter moves it has the jitter in it. toClip: y down.
bool holdsJitter(const mat4& toClip, vec2 jitter, uvec2 size) {
    const bool perspective = toClip[2][3] != 0.0F;
    const vec2 offset = perspective ? vec2(toClip[2]) / toClip[2][3] : vec2(toClip[3]);
    const vec2 moved = -2.0F * jitter / vec2(size);
    return glm::length(jitter) > 0.05F && glm::length(offset - moved) < 0.05F * glm::length(moved);
}

}  // namespace

ViewParams viewParams(const RefletFrameInfo& info, RefletDepthKind depthKind, uvec2 size, uvec2 before) {
    const mat4 toView = rigid(info.worldToView, "worldToView");
    const mat4 toClip = reflectedProjection(matrixOf(info.viewToClip, "viewToClip"), info, depthKind);
    // A perspective matrix has 1 or -1 there, and its transposed one has it here.
    if (std::abs(info.viewToClip[14]) == 1.0F && std::abs(info.viewToClip[11]) != 1.0F && info.viewToClip[11] != 0.0F) {
        failArgument(
            "RefletFrameInfo.viewToClip: [11] is {}, and [14] is {}: it is transposed; matrices are column-major",
            info.viewToClip[11], info.viewToClip[14]);
    }
    ViewParams v = lighting::viewOf(toView, toClip, size);
    checkProjection(toClip, v.clipToWorld, depthKind);
    const bool first = isZero(info.previousWorldToView) && isZero(info.previousViewToClip);
    if (!first) {
        const mat4 was = reflectedProjection(matrixOf(info.previousViewToClip, "previousViewToClip"), info, depthKind);
        if (was[0][0] == 0.0F || was[1][1] == 0.0F) {
            failArgument("RefletFrameInfo.previousViewToClip: is no projection; both former matrices, or none");
        }
        v.previousWorldToClip = was * rigid(info.previousWorldToView, "previousWorldToView");
    }
    v.frame = info.frameIndex;
    v.rest = info.restFrames;
    const vec2 jitter = jitterOf(info.jitter, "jitter");
    if (holdsJitter(toClip, jitter, size)) {
        failArgument("RefletFrameInfo.viewToClip: has the jitter in it; give the projection without jitter");
    }
    const vec2 jitterBefore = jitterOf(info.previousJitter, "previousJitter");
    applyJitter(v, jitter, size == before ? jitterBefore : jitterBefore * vec2(size) / vec2(before));
    return v;
}

ImportParams importParams(const RefletFrameInfo& info, const RefletGBuffer& g, const ViewParams& view) {
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
    const vec2 scale(g.motionScale[0], g.motionScale[1]);
    for (const int axis : {0, 1}) {
        if (!(std::abs(scale[axis]) < 1e6F)) {
            failArgument("RefletGBuffer.motionScale[{}]: is {}; must be a factor", axis, scale[axis]);
        }
    }
    if ((scale.x == 0.0F) != (scale.y == 0.0F)) {
        failArgument("RefletGBuffer.motionScale: is ({}, {}); must be two factors, or both 0 for 1", scale.x, scale.y);
    }
    params.motionToUv = factor * (scale == vec2(0.0F) ? vec2(1.0F) : scale);
    params.motionOffset = g.motionIncludesJitter != 0 ? view.jitterChange : vec2(0.0F);
    return params;
}

}  // namespace reflet::api
