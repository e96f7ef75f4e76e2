// G-buffer: clip-space positions of this frame and the last, normal and tangent in world space.
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "effects/gbuffer/gbuffer.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/draw_gbuffer/exact_transform.glsl"

layout(constant_id = 1) const uint bent = 0u;  // 1: some vertices are skinned or morphed

layout(scalar) uniform ParamsBlock { GBufferParams params; };
layout(push_constant, scalar) uniform DrawBlock {
    mat4x3 objectToWorld;
    mat4x3 previousObjectToWorld;
} draw;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;
layout(location = 6) in vec3 previousPosition;

layout(location = 0) out vec3 normalW;
layout(location = 1) out vec4 tangentW;
layout(location = 2) out vec4 uv;
layout(location = 3) out vec4 vertexColor;
layout(location = 4) out vec3 clipNow;
layout(location = 5) out vec4 clipBefore;  // and own motion away from the camera along its axis [m]
layout(location = 6) out vec3 fromEye;
invariant gl_Position;  // must be identical to back_depth.vert

void main() {
    mat3 m = mat3(draw.objectToWorld);
    // Cofactor matrix: the inverse transpose times the determinant, whose sign is removed below.
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    float handedness = dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
    normalW = normalize(cofactors * normal) * handedness;
    tangentW = vec4(m * tangent.xyz, tangent.w * handedness);
    uv = vec4(uv0, uv1);
    vertexColor = color;
    // What does not move has the same coordinates in both frames, bit by bit.
    vec3 positionW = exactTransform(draw.objectToWorld, position);
    vec4 clip = exactTransform(params.view.worldToClip, positionW);
    gl_Position = clip;
    fromEye = positionW - params.view.eye.xyz * params.view.eye.w;
    clipNow = clip.xyw;
    vec3 beforeO = bent != 0u ? previousPosition : position;
    vec3 beforeW = exactTransform(draw.previousObjectToWorld, beforeO);
    vec4 before = exactTransform(params.view.previousWorldToClip, beforeW);
    clipBefore = vec4(before.xyw, dot(params.view.viewPlane.xyz, positionW - beforeW));
}
